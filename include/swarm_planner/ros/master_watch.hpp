// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace swarm_planner {

/// Registers this node again with a ROS master that has been started anew and so knows nothing of it; roscpp does not.
/// Then services can be called and topics be found as before. Connections that are open stay open.
///
/// Not registered are subscriptions to topics that have several publishers, as /tf: the new master would sooner or
/// later tell only those of them that it knows, and roscpp cuts the connections to all others.
///
/// Has a thread of its own, as a call of the master takes as long as the network wants.
class MasterWatch {
 public:
  /// To be made when the node has advertised all its services.
  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

 private:
  void run();
  /// False if the master went away meanwhile.
  bool registerAll() const;

  const std::vector<std::string> services_;  ///< of this node
  bool is_complete_ = true;                  ///< the last registration
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;   ///< guarded by mutex_
  std::thread thread_;  ///< last: uses the others
};

}  // namespace swarm_planner
