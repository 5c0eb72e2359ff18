// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace swarm_planner {

/// What is wrong with a configuration file or parameter: where, which key, and what was expected.
struct Fault {
  std::string source;   ///< file name or "parameters"
  std::string key;      ///< full path of the key, e.g. "uavs[2].target.speed"
  std::string message;  ///< what was found and what was expected
};

/// Collects every fault of a configuration, so that a user sees all of them at once.
class Faults {
 public:
  void add(std::string source, std::string key, std::string message);
  bool empty() const { return list_.empty(); }
  const std::vector<Fault>& list() const { return list_; }
  /// One fault a line: "file: key: message".
  std::string text() const;
  /// Throws ConfigError with text() if there is any fault.
  void throwIfAny() const;

 private:
  std::vector<Fault> list_;
};

/// A configuration cannot be used; what() lists every fault.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace swarm_planner
