// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <chrono>

namespace swarm_planner {

/// Measures how long a computation takes. It never tells what time it is: time is passed in.
class Stopwatch {
 public:
  /// Seconds of wall clock since construction.
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace swarm_planner
