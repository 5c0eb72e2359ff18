// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/obstacle_sim_node.hpp"

#include <utility>

#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/time_conversion.hpp"
#include "swarm_planner/ros/track_conversion.hpp"

namespace swarm_planner {

namespace {

// Between looks for messages that are due [s].
constexpr double kPublicationPeriod = 0.01;
// A run begins about a cycle ahead [s].
constexpr double kMostAhead = 60.0;
// As diagnostics call it.
constexpr char kStatus[] = "planner status";

}  // namespace

ObstacleSimNode::ObstacleSimNode(const Mission& mission)
    : frame_id_(mission.scenario.frame_id),
      link_(mission.parameters.simulation,
            streamSeed(static_cast<std::uint64_t>(mission.parameters.simulation.seed), RandomUse::kTrackLink)),
      faults_(mission, static_cast<std::uint64_t>(mission.parameters.simulation.seed)),
      watch_(node_),
      fault_service_(mission, faults_, concernsTracks, [] { return toSeconds(ros::Time::now()); }) {
  for (const ScenarioObstacle& obstacle : mission.scenario.obstacles) obstacles_.push_back(makeObstacle(obstacle));
  publisher_ = node_.advertise<ObstacleTrackArray>(kObstacleTracksTopic, kObstacleTracksQueueSize);
  const auto most_bytes = kMostStatusBytesPerUav * static_cast<std::uint32_t>(mission.scenario.uavs.size() + 1);
  status_subscriber_ = subscribeGuarded<PlannerStatus>(
      node_, kPlannerStatusTopic, {kStatusQueueSize, most_bytes},
      [this](const PlannerStatus& status) { receiveStatus(status); },
      [this](InputFault fault, const std::string& why) { watch_.refuse(kStatus, fault, why); });
  const SimulationParameters& simulation = mission.parameters.simulation;
  measurement_timer_ =
      node_.createTimer(ros::Duration(1.0 / simulation.track_rate), [this](const ros::TimerEvent&) { measure(); });
  if (simulation.latency > 0.0 || simulation.jitter > 0.0) {
    publication_timer_ =
        node_.createTimer(ros::Duration(kPublicationPeriod), [this](const ros::TimerEvent&) { publish(); });
  }
}

void ObstacleSimNode::receiveStatus(const PlannerStatus& status) {
  const double time_zero = toSeconds(status.time_zero);
  if (status.started && !(time_zero > 0.0 && time_zero < toSeconds(ros::Time::now()) + kMostAhead)) {
    watch_.refuse(kStatus, InputFault::kAbsurd, "its t = 0 cannot be");
    return;
  }
  watch_.accept(kStatus);
  const std::optional<double> before = time_zero_;
  time_zero_.reset();
  if (status.started) time_zero_ = time_zero;
  if (time_zero_ && time_zero_ != before) faults_.scheduleScenario(*time_zero_);
}

void ObstacleSimNode::measure() {
  const ros::Time now = ros::Time::now();
  const double run_time = time_zero_ ? toSeconds(now) - *time_zero_ : 0.0;
  ObstacleTrackArray message;
  message.header.frame_id = frame_id_;
  message.header.stamp = now;
  faults_.advanceTo(toSeconds(now));
  if (!faults_.tracksArrive()) return;
  for (const Superellipsoid& obstacle : obstacles_) {
    if (faults_.trackIsSeen()) message.tracks.push_back(toMessage(obstacle.movedBy(run_time)));
  }
  link_.send(toSeconds(now), std::move(message));
  publish();
}

void ObstacleSimNode::publish() {
  link_.deliver(toSeconds(ros::Time::now()),
                [this](double, const ObstacleTrackArray& message) { publisher_.publish(message); });
}

}  // namespace swarm_planner
