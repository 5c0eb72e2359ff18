// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/status_conversion.hpp"

#include <array>
#include <cstdio>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

static_assert(UavStatus::TRACKING == static_cast<int>(UavState::kTracking), "message and core must agree");
static_assert(UavStatus::HOLDING == static_cast<int>(UavState::kHolding), "message and core must agree");
static_assert(UavStatus::FALLBACK == static_cast<int>(UavState::kFallback), "message and core must agree");
static_assert(UavStatus::LOST == static_cast<int>(UavState::kLost), "message and core must agree");
static_assert(UavStatus::LANDING == static_cast<int>(UavState::kLanding), "message and core must agree");
static_assert(UavStatus::STOPPED == static_cast<int>(UavState::kStopped), "message and core must agree");

// More names than this would only fill the screen.
constexpr int kMostNames = 5;

std::string missingNames(const SwarmPlanner& planner, const std::vector<UavInput>& inputs) {
  std::string names;
  int missing = 0;
  for (std::size_t uav = 0; uav < inputs.size(); ++uav) {
    if (inputs[uav].received || planner.isForeign(uav)) continue;
    if (++missing <= kMostNames) names += (missing > 1 ? ", " : "") + planner.uavName(uav);
  }
  if (missing > kMostNames) names += " and " + std::to_string(missing - kMostNames) + " more";
  return names;
}

}  // namespace

std::string describeReason(const SwarmPlanner& planner, std::size_t uav, const std::vector<UavInput>& inputs,
                           const std::string& odometry_topic) {
  const Reason reason = planner.report().uavs[uav].reason;
  if (reason == Reason::kNone) return "";
  const std::string& fault = inputs[uav].fault;
  if (reason == Reason::kWaitingForOdometry) {
    return fault.empty() ? "waiting for odometry: nothing received on " + odometry_topic : fault;
  }
  if (reason == Reason::kWaitingForOthers) return "waiting for odometry of " + missingNames(planner, inputs);
  if (reason == Reason::kOdometryStale && !fault.empty()) return std::string(reasonText(reason)) + ": " + fault;
  if (reason == Reason::kOffPlan) {
    std::array<char, 32> distance;
    std::snprintf(distance.data(), distance.size(), "%.1f m ", planner.report().uavs[uav].deviation);
    return distance.data() + std::string(reasonText(reason));
  }
  if (isTraffic(reason)) {
    return std::string(reasonText(reason)) + " " + planner.uavName(planner.report().uavs[uav].partner);
  }
  return explainReason(reason, planner.report().uavs[uav].refusal);
}

void toMessage(const SwarmPlanner& planner, const CycleContext& context, const std::vector<std::string>& reasons,
               PlannerStatus& message) {
  const CycleReport& report = planner.report();
  message.header.stamp = toRosTime(context.stamp);
  message.header.frame_id = context.frame;
  message.cycle = report.cycle;
  message.epoch = toRosTime(report.epoch);
  message.started = report.started;
  message.time_zero = report.started ? toRosTime(report.time_zero) : ros::Time();
  message.cycle_time = report.cycle_time;
  message.deadline_missed = context.deadline_missed;
  message.deadline_misses = context.deadline_misses;
  message.out_of_time = report.out_of_time;
  message.rejected_plans = context.rejected_plans;
  message.refused_tracks = static_cast<std::uint32_t>(report.refused_tracks);
  message.uavs.resize(report.uavs.size());
  for (std::size_t uav = 0; uav < report.uavs.size(); ++uav) {
    const UavReport& from = report.uavs[uav];
    UavStatus& to = message.uavs[uav];
    to.name = planner.uavName(uav);
    to.state = static_cast<std::uint8_t>(from.state);
    to.reason = reasons[uav];
    to.alarm = isAlarm(from.reason);
    to.commanded = isCommanded(from.reason) || isTraffic(from.reason);
    to.refusal = from.refusal == CheckReason::kAccepted ? "" : checkReasonText(from.refusal);
    to.planned = from.planned;
    to.solve_time = from.solve_time;
    to.sqp_iterations = static_cast<std::uint32_t>(from.sqp_iterations);
    to.qp_iterations = static_cast<std::uint32_t>(from.qp_iterations);
    to.max_slack = from.max_slack;
    to.deviation = from.deviation;
    to.obstacle_clearance = from.obstacle_clearance;
    to.uav_distance = from.pair_distance;
    to.lag = from.lag;
    to.target = toPoint(planner.target(uav, report.epoch).p);
  }
}

}  // namespace swarm_planner
