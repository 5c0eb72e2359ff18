// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/guide_thread.hpp"

#include <sys/resource.h>

namespace swarm_planner {
namespace {

constexpr int kNiceness = 10;  // added to the process's own

}  // namespace

GuideThread::~GuideThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  woken_.notify_one();
  thread_.join();
}

void GuideThread::wake() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_woken_ = true;
  }
  woken_.notify_one();
}

void GuideThread::serve() {
  // On Linux this is the niceness of the calling thread alone. Without it searches take turns with the cycle.
  static_cast<void>(setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kNiceness));
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      woken_.wait(lock, [this] { return is_woken_ || stop_; });
      if (stop_) return;
      is_woken_ = false;
    }
    planner_.searchGuides();
  }
}

}  // namespace swarm_planner
