// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// A thread that searches guides beside the planning cycle, less urgent than that.
class GuideThread {
 public:
  /// The planner must outlive the thread.
  explicit GuideThread(SwarmPlanner& planner) : planner_(planner), thread_([this] { serve(); }) {}
  ~GuideThread();
  GuideThread(const GuideThread&) = delete;
  GuideThread& operator=(const GuideThread&) = delete;

  /// A cycle has ended: there may be something to search.
  void wake();

 private:
  void serve();

  SwarmPlanner& planner_;
  std::mutex mutex_;
  std::condition_variable woken_;
  bool is_woken_ = false;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace swarm_planner
