// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "solver/compiled_program.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace swarm_planner {
namespace codegen {
namespace {

std::string named(std::string text, const std::string& name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const std::pair<std::string, std::string> replacements[] = {{"NAME", name}, {"PREFIX", upper}};
  for (const auto& replacement : replacements) {
    for (std::size_t at = text.find(replacement.first); at != std::string::npos;
         at = text.find(replacement.first, at + replacement.second.size())) {
      text.replace(at, replacement.first.size(), replacement.second);
    }
  }
  return text;
}

void writeFile(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
}

void runCommand(const std::string& command) {
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

}  // namespace

CompiledProgram::CompiledProgram(const GeneratedCode& code, const std::string& driver,
                                 const std::string& compiler_flags)
    : name_(code.name) {
  char folder[] = "/tmp/generated_solver_XXXXXX";
  if (mkdtemp(folder) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = folder;
  writeFile(folder_ + "/" + name_ + ".h", code.header);
  writeFile(folder_ + "/" + name_ + ".c", code.source);
  writeFile(folder_ + "/driver.c", named(driver, name_));
  const std::string compile = "cd " + folder_ + " && cc -std=c99 -Wall -Wextra -Werror " + compiler_flags + " -c ";
  runCommand(compile + name_ + ".c -o solver.o");
  runCommand(compile + "driver.c -o driver.o");
  runCommand("cd " + folder_ + " && cc " + compiler_flags + " driver.o solver.o -o driver");
}

CompiledProgram::~CompiledProgram() {
  for (const std::string& file :
       {name_ + ".h", name_ + ".c", std::string("driver.c"), std::string("solver.o"), std::string("driver.o"),
        std::string("driver"), std::string("in"), std::string("out"), std::string("symbols")}) {
    std::remove((folder_ + "/" + file).c_str());
  }
  rmdir(folder_.c_str());
}

std::vector<double> CompiledProgram::run(const std::vector<double>& in) const {
  std::ofstream(folder_ + "/in", std::ios::binary)
      .write(reinterpret_cast<const char*>(in.data()), static_cast<std::streamsize>(in.size() * sizeof(double)));
  runCommand("cd " + folder_ + " && ./driver < in > out");
  std::ifstream file(folder_ + "/out", std::ios::binary | std::ios::ate);
  std::vector<double> out(static_cast<std::size_t>(file.tellg()) / sizeof(double));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size() * sizeof(double)));
  if (!file) throw std::runtime_error("the program's output cannot be read");
  return out;
}

std::string CompiledProgram::undefinedSymbols(const std::string& compiler) const {
  runCommand("cd " + folder_ + " && " + compiler + " -std=c99 -Wall -Wextra -pedantic -Werror -c " + name_ +
             ".c -o solver.o");
  return undefinedSymbols();
}

std::string CompiledProgram::undefinedSymbols() const {
  runCommand("cd " + folder_ + " && nm -u solver.o > symbols");
  std::ifstream file(folder_ + "/symbols");
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

}  // namespace codegen
}  // namespace swarm_planner
