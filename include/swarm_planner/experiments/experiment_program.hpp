// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace swarm_planner {

/// Exit status of swarm_experiment.
enum ExperimentStatus : int {
  kExperimentDone = 0,     ///< flown, whatever happened in the air
  kExperimentFailed = 1,   ///< faults in a scenario or parameter file, or a result that could not be written
  kExperimentMisused = 2,  ///< the command line cannot be used
};

/// Does what the arguments (without the program's name) ask for: results to `out`, messages to `err`.
int runExperimentProgram(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace swarm_planner
