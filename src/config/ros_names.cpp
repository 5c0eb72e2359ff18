// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "ros_names.hpp"

#include <algorithm>

namespace swarm_planner {

namespace {

// <cctype> depends on the locale; ROS names do not.
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

bool isGraphName(const std::string& name) {
  if (name.empty() || !isLetter(name.front()) || name.back() == '/') return false;
  if (name.find("//") != std::string::npos) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '/'; });
}

bool isFrameName(const std::string& name) {
  constexpr char kLastControl = ' ', kDelete = 127;
  if (name.empty() || name.front() == '/') return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return c > kLastControl && c != kDelete; });
}

}  // namespace swarm_planner
