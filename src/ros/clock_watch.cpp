// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/clock_watch.hpp"

#include <cstdio>

namespace swarm_planner {

void ClockWatch::note(double now, double wall) {
  if (now != now_) {
    if (now < now_) noteJumpBack(wall);
    now_ = now;
    since_ = wall;
  }
  fault_.clear();
  if (jumps_ >= kMostJumps && wall - last_jump_ < kCalm) {
    fault_ = "ROS time has jumped back " + std::to_string(jumps_) +
             " times: is there a second source of /clock? The run starts anew each time";
    return;
  }
  if (wall - since_ < kPatience) return;
  if (now == 0.0) {
    fault_ = "no planning: waiting for ROS time, nothing has come on /clock (use_sim_time is set)";
    return;
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "no planning: ROS time (/clock) has stood still at %.2f s for %.0f s; UAVs end their last trajectories",
                now, wall - since_);
  fault_ = text;
}

bool ClockWatch::noteJumpBack(double wall) {
  if (wall - last_jump_ >= kCalm) jumps_ = 0;
  ++jumps_;
  last_jump_ = wall;
  return jumps_ < kMostJumps;
}

}  // namespace swarm_planner
