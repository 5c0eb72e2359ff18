// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "swarm_planner/config/parameters.hpp"

namespace swarm_planner {

/// A protection that an experiment can leave out to show what it is good for.
struct NegativeControl {
  const char* name;             ///< as --without and the results call it
  const char* parameter;        ///< false: left out
  bool LimitParameters::*kept;  ///< the same parameter
};

constexpr std::array<NegativeControl, 6> kNegativeControls{{
    {"check", "plan_check", &LimitParameters::plan_check},
    {"segments", "segment_constraints", &LimitParameters::segment_constraints},
    {"latency", "latency_compensation", &LimitParameters::latency_compensation},
    {"guide", "guide", &LimitParameters::guide},
    {"avoidance", "avoidance", &LimitParameters::avoidance},
    {"right_of_way", "right_of_way", &LimitParameters::right_of_way},
}};

/// The names of what is left out.
inline std::vector<std::string> leftOut(const LimitParameters& limits) {
  std::vector<std::string> names;
  for (const NegativeControl& control : kNegativeControls) {
    if (!(limits.*control.kept)) names.emplace_back(control.name);
  }
  return names;
}

}  // namespace swarm_planner
