// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/config/faults.hpp"

#include <utility>

namespace swarm_planner {
namespace {

// Of a key or a message [characters]: what a file says is repeated only so far.
constexpr std::size_t kMostText = 300;

std::string excerpt(std::string text) {
  if (text.size() <= kMostText) return text;
  return text.substr(0, kMostText) + "... (" + std::to_string(text.size()) + " characters)";
}

}  // namespace

void Faults::add(std::string source, std::string key, std::string message) {
  list_.push_back({std::move(source), excerpt(std::move(key)), excerpt(std::move(message))});
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
