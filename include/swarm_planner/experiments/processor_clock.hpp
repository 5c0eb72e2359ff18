// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <time.h>

namespace swarm_planner {

/// Measures the processor time of the calling thread: unlike the wall clock's, not that of other programs on the
/// machine.
class ProcessorClock {
 public:
  ProcessorClock() : begin_(now()) {}
  double elapsed() const { return now() - begin_; }  ///< since construction [s]

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double begin_;
};

}  // namespace swarm_planner
