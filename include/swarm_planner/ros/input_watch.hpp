// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/time.h>
#include <ros/wall_timer.h>

#include <cstdint>
#include <map>
#include <string>

#include "swarm_planner/ros/input_fault.hpp"

namespace swarm_planner {

/// Counts what the inputs of a node refuse, tells the operator on the console, at most every 5 s for each input, and
/// publishes the counts on /diagnostics twice per second. For nodes with one thread.
class InputWatch {
 public:
  explicit InputWatch(ros::NodeHandle& node);

  void accept(const std::string& input) { ++inputs_[input].accepted; }
  /// `count` of what `input` brought are not used, because `why`, a sentence of bounded length.
  void refuse(const std::string& input, InputFault fault, const std::string& why);
  /// The same for the parts of one message.
  void refuse(const std::string& input, const FaultCounts& dropped, const std::string& why);

 private:
  struct Input {
    std::uint64_t accepted = 0;
    FaultCounts dropped;
    std::uint64_t reported = 0;  ///< of those dropped, in the last diagnostics
    ros::WallTime next_warning;
  };

  void describe(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::map<std::string, Input> inputs_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

/// Adds the counts to a diagnostic entry: all under `what`, and each fault that there was under its name.
void addDropped(const std::string& what, const FaultCounts& dropped,
                diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace swarm_planner
