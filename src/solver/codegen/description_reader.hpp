// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "swarm_planner/solver/codegen/description.hpp"

namespace swarm_planner {
namespace codegen {

/// The text as a map. @throws DescriptionError if it is none
YAML::Node parseMap(const std::string& yaml_text);

bool isIdentifier(const std::string& name);

std::uint64_t fnv1a(const std::string& text);

/// What the readers of all kinds of description share: faults are collected with their place and reported at once.
class DescriptionReader {
 protected:
  void fault(const std::string& key, const std::string& message) { faults_ << key << ": " << message << "\n"; }
  bool faulty() const { return !faults_.str().empty(); }
  /// @throws DescriptionError with all faults, if there are any
  void throwFaults() const;

  void allowKeys(const YAML::Node& node, const std::string& where, const std::set<std::string>& keys);
  /// A whole number of at least `least`. Without the key: `fallback`, or a fault where that is negative.
  int integer(const YAML::Node& node, const std::string& where, const std::string& key, int least, int fallback = -1);
  Expression number(const YAML::Node& node, const std::string& where);
  std::vector<Expression> list(const YAML::Node& node, const std::string& where);
  /// A matrix is a list of rows, {diagonal: [...]}, {identity: n} or {kron: [matrix, matrix]}.
  ExpressionMatrix matrix(const YAML::Node& node, const std::string& where);

  std::string readName(const YAML::Node& root);
  /// Names with their defaults; formulas that are read later may use them.
  std::vector<std::pair<std::string, double>> readParameters(const YAML::Node& node);
  std::vector<Penalty> readPenalties(const YAML::Node& node);
  std::vector<std::string> readInstructionSets(const YAML::Node& node);
  /// The index of the penalty of that name; -1, with a fault, if there is none.
  int findPenalty(const std::vector<Penalty>& penalties, const std::string& name, const std::string& where);

  std::map<std::string, double> parameters_;

 private:
  ExpressionMatrix denseMatrix(const YAML::Node& node, const std::string& where);

  std::ostringstream faults_;
};

}  // namespace codegen
}  // namespace swarm_planner
