// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/config/faults.hpp"

#include <utility>

namespace swarm_planner {

void Faults::add(std::string source, std::string key, std::string message) {
  list_.push_back({std::move(source), std::move(key), std::move(message)});
}

std::string Faults::text() const {
  std::string text;
  for (const Fault& fault : list_) {
    if (!text.empty()) text += '\n';
    text += fault.source + ": ";
    if (!fault.key.empty()) text += fault.key + ": ";
    text += fault.message;
  }
  return text;
}

void Faults::throwIfAny() const {
  if (!empty()) throw ConfigError(text());
}

}  // namespace swarm_planner
