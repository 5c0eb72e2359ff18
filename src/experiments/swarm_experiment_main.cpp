// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <iostream>

#include "swarm_planner/experiments/experiment_program.hpp"

int main(int argc, char** argv) {
  return swarm_planner::runExperimentProgram({argv + 1, argv + argc}, std::cout, std::cerr);
}
