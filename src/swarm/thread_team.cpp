// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/thread_team.hpp"

namespace swarm_planner {

ThreadTeam::ThreadTeam(std::size_t size) {
  threads_.reserve(size - 1);
  for (std::size_t member = 1; member < size; ++member) threads_.emplace_back([this, member] { serve(member); });
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  loop_started_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run(std::size_t begin, std::size_t end, const void* function, Call call) {
  // A loop of one item is not worth waking anybody for.
  if (threads_.empty() || end - begin < 2) {
    for (std::size_t item = begin; item < end; ++item) call(function, item, 0);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    function_ = function;
    call_ = call;
    end_ = end;
    next_.store(begin, std::memory_order_relaxed);
    working_ = threads_.size();
    ++loop_;
  }
  loop_started_.notify_all();
  work(0);
  std::unique_lock<std::mutex> lock(mutex_);
  loop_done_.wait(lock, [this] { return working_ == 0; });
}

void ThreadTeam::work(std::size_t member) {
  for (;;) {
    const std::size_t item = next_.fetch_add(1, std::memory_order_relaxed);
    if (item >= end_) return;
    call_(function_, item, member);
  }
}

void ThreadTeam::serve(std::size_t member) {
  std::uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      loop_started_.wait(lock, [&] { return stop_ || loop_ != seen; });
      if (stop_) return;
      seen = loop_;
    }
    work(member);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--working_ == 0) loop_done_.notify_one();
  }
}

}  // namespace swarm_planner
