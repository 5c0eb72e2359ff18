// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// qp_codegen SPEC.yaml OUTPUT_DIR: writes NAME.h and NAME.c, a solver for the QP structure that SPEC.yaml describes,
// with stages or sparse without.
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "swarm_planner/solver/codegen/generator.hpp"

namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: qp_codegen SPEC.yaml OUTPUT_DIR\n";
    return 2;
  }
  try {
    const auto code = swarm_planner::codegen::generateFromText(swarm_planner::codegen::readDescriptionText(argv[1]));
    const std::string stem = std::string(argv[2]) + "/" + code.name;
    write(stem + ".h", code.header);
    write(stem + ".c", code.source);
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ":\n" << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
