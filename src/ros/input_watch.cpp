// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/input_watch.hpp"

#include <ros/console.h>

#include "swarm_planner/ros/node_constants.hpp"

namespace swarm_planner {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kReportPeriod = 0.5;  // [s]

}  // namespace

void addDropped(const std::string& what, const FaultCounts& dropped,
                diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.add(what, dropped.total());
  for (std::size_t i = 1; i < kInputFaults; ++i) {
    const auto fault = static_cast<InputFault>(i);
    if (dropped.of(fault) > 0) status.add(what + ": " + faultText(fault), dropped.of(fault));
  }
}

InputWatch::InputWatch(ros::NodeHandle& node) {
  updater_.setHardwareID("swarm_planner");
  updater_.add("inputs", this, &InputWatch::describe);
  timer_ = node.createWallTimer(ros::WallDuration(kReportPeriod),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void InputWatch::refuse(const std::string& input, InputFault fault, const std::string& why) {
  FaultCounts dropped;
  dropped.add(fault);
  refuse(input, dropped, why);
}

void InputWatch::refuse(const std::string& input, const FaultCounts& dropped, const std::string& why) {
  Input& source = inputs_[input];
  source.dropped.add(dropped);
  const ros::WallTime now = ros::WallTime::now();
  if (now < source.next_warning) return;
  source.next_warning = now + ros::WallDuration(kWarningPeriod);
  ROS_WARN_STREAM(input << " ignored: " << why);
}

void InputWatch::describe(diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.summary(DiagnosticStatus::OK, "no input refused");
  for (auto& [name, input] : inputs_) {
    const std::uint64_t dropped = input.dropped.total();
    if (dropped > input.reported) status.mergeSummary(DiagnosticStatus::WARN, name + " refused");
    input.reported = dropped;
    status.add(name + " accepted", input.accepted);
    addDropped(name + " dropped", input.dropped, status);
  }
}

}  // namespace swarm_planner
