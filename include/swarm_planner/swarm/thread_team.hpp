// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace swarm_planner {

/// A fixed number of threads that share out the items of one loop after another. Starting a loop allocates nothing.
class ThreadTeam {
 public:
  /// `size` >= 1 threads, the caller of forEach among them.
  explicit ThreadTeam(std::size_t size);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  std::size_t size() const { return threads_.size() + 1; }

  /// Calls function(item, member) once for every item in [begin, end), on any member 0 .. size() - 1, and returns when
  /// all are done. `function` must not throw.
  template <class Function>
  void forEach(std::size_t begin, std::size_t end, const Function& function) {
    run(begin, end, &function,
        [](const void* f, std::size_t item, std::size_t member) { (*static_cast<const Function*>(f))(item, member); });
  }

 private:
  using Call = void (*)(const void* function, std::size_t item, std::size_t member);

  void run(std::size_t begin, std::size_t end, const void* function, Call call);
  void work(std::size_t member);
  void serve(std::size_t member);

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable loop_started_;
  std::condition_variable loop_done_;
  std::uint64_t loop_ = 0;   ///< counts loops; a change wakes the threads
  std::size_t working_ = 0;  ///< threads that have not finished the loop
  bool stop_ = false;
  const void* function_ = nullptr;
  Call call_ = nullptr;
  std::size_t end_ = 0;
  std::atomic<std::size_t> next_{0};
};

}  // namespace swarm_planner
