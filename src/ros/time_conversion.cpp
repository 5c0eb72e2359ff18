// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/time_conversion.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace swarm_planner {

double toSeconds(const ros::Time& time) { return time.toSec(); }

ros::Time toRosTime(double seconds) {
  constexpr double kLast = std::numeric_limits<std::uint32_t>::max();
  if (!(seconds > 0.0)) return ros::Time();
  if (seconds >= kLast) return ros::TIME_MAX;
  const double whole = std::floor(seconds);
  // Normalises a fraction that rounds up to a whole second.
  return ros::Time(static_cast<std::uint32_t>(whole), 0) +
         ros::Duration(0, static_cast<std::int32_t>(std::lround((seconds - whole) * 1e9)));
}

}  // namespace swarm_planner
