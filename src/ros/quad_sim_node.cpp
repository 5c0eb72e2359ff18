// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/quad_sim_node.hpp"

#include <ros/console.h>
#include <ros/init.h>

#include <algorithm>
#include <fstream>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/quad_odometry.hpp"
#include "swarm_planner/ros/time_conversion.hpp"
#include "swarm_planner/ros/track_conversion.hpp"
#include "swarm_planner/ros/trajectory_conversion.hpp"

namespace swarm_planner {
namespace {

// The run is measured, and /clock advances, in such steps [s].
constexpr double kStep = 0.01;
// Between two commands to an external UAV: steps.
constexpr std::uint64_t kExternalSteps = 20;
// A longer gap is a jump of time, not a delay to make up for [s].
constexpr double kJump = 1.0;
// A status that begins a new run each time fills no console [s].
constexpr double kNewsPeriod = 1.0;
// A run begins about a cycle ahead [s].
constexpr double kMostAhead = 60.0;
// No planner takes longer for a cycle [s].
constexpr double kLongestCycle = 3600.0;
// Tracks that a message may have beyond the scenario's obstacles, and what one of them takes [bytes].
constexpr std::size_t kSpareTracks = 1000;
constexpr std::uint32_t kTrackBytes = 160;
// Inputs, as diagnostics call them.
constexpr char kTracks[] = "obstacle tracks";
constexpr char kStatus[] = "planner status";

}  // namespace

QuadSimNode::QuadSimNode(const Mission& mission, const QuadSimOptions& options)
    : mission_(mission),
      options_(options),
      clock_(options.speed),
      faults_(mission, static_cast<std::uint64_t>(mission.parameters.simulation.seed)),
      frames_(no_transforms_, mission_.scenario.frame_id, 0.0),
      samples_(mission.scenario.uavs.size()),
      watch_(node_),
      fault_service_(mission_, faults_, concernsVehicles, [this] { return time_; }) {
  const auto seed = static_cast<std::uint64_t>(mission_.parameters.simulation.seed);
  const SimulationParameters& simulation = mission_.parameters.simulation;
  for (const ScenarioUav& uav : mission_.scenario.uavs) {
    const std::size_t index = quads_.size();
    trajectory_links_.emplace_back(simulation, streamSeed(seed, RandomUse::kSetpointLink, index));
    odometry_links_.emplace_back(simulation, streamSeed(seed, RandomUse::kOdometryLink, index));
    quads_.emplace_back(mission_.parameters, uav.start, seed, index);
    externals_.emplace_back();
    if (uav.external) externals_.back().emplace(uav);
    odometry_.push_back(
        node_.advertise<nav_msgs::Odometry>(nameForUav(options_.odometry_topic, uav.name), kOdometryQueueSize));
  }
  for (const ScenarioObstacle& obstacle : mission_.scenario.obstacles) {
    obstacles_.emplace_back();
    obstacles_.back().shape = makeObstacle(obstacle);
  }
  subscribe();
  if (options_.live_map) {
    live_map_.emplace(mission_, MapOptions(), frames_, MapInput::Bodies(), [](const VoxelMap&) {});
  }
  // Steps are due by the clock that makes ROS time; a ROS timer would wait for itself there.
  if (clock_.makesRosTime()) {
    wall_timer_ = node_.createWallTimer(ros::WallDuration(kStep / options_.speed),
                                        [this](const ros::WallTimerEvent&) { catchUp(); });
  } else {
    timer_ = node_.createTimer(ros::Duration(kStep), [this](const ros::TimerEvent&) { catchUp(); });
  }
}

void QuadSimNode::subscribe() {
  subscribeTrajectories();
  const auto refuse = [this](const char* input) {
    return [this, input](InputFault fault, const std::string& why) { watch_.refuse(input, fault, why); };
  };
  // The truth of this scenario: a message with far more than its obstacles is none.
  const auto most_tracks = static_cast<std::uint32_t>(obstacles_.size() + kSpareTracks);
  subscribers_.push_back(subscribeGuarded<ObstacleTrackArray>(
      node_, kObstacleTracksTopic, {kObstacleTracksQueueSize, most_tracks * kTrackBytes},
      [this](const ObstacleTrackArray& message) { receiveTracks(message); }, refuse(kTracks)));
  subscribers_.push_back(subscribeGuarded<PlannerStatus>(
      node_, kPlannerStatusTopic,
      {kStatusQueueSize, kMostStatusBytesPerUav * static_cast<std::uint32_t>(quads_.size() + 1)},
      [this](const PlannerStatus& status) { receiveStatus(status); }, refuse(kStatus)));
}

void QuadSimNode::subscribeTrajectories() {
  for (std::size_t uav = 0; uav < quads_.size(); ++uav) {
    const std::string& name = mission_.scenario.uavs[uav].name;
    subscribers_.push_back(subscribeGuarded<trajectory_msgs::MultiDOFJointTrajectory>(
        node_, nameForUav(options_.trajectory_topic, name), {kTrajectoryQueueSize, kMostTrajectoryBytes},
        [this, uav](const trajectory_msgs::MultiDOFJointTrajectory& message) { receiveTrajectory(uav, message); },
        [this, name](InputFault fault, const std::string& why) {
          watch_.refuse("trajectory of " + name, fault, why);
        }));
  }
}

void QuadSimNode::receiveTrajectory(std::size_t uav, const trajectory_msgs::MultiDOFJointTrajectory& message) {
  const std::string input = "trajectory of " + mission_.scenario.uavs[uav].name;
  InputFault fault = faultOf(message);
  std::string why = std::string("it cannot be flown: ") + faultText(fault);
  if (fault == InputFault::kNone && message.header.frame_id != mission_.scenario.frame_id) {
    fault = InputFault::kFrame;
    why = "in frame '" + shortened(message.header.frame_id) + "', expected '" + mission_.scenario.frame_id + "'";
  }
  if (fault == InputFault::kNone) {
    watch_.accept(input);
    trajectory_links_[uav].send(time_, toSetpoints(message));
  } else {
    watch_.refuse(input, fault, why);
  }
  deliverTrajectories(uav);
}

void QuadSimNode::deliverTrajectories(std::size_t uav) {
  trajectory_links_[uav].deliver(time_, [this, uav](double arrival, const SetpointTrajectory& trajectory) {
    quads_[uav].advanceTo(arrival);
    if (!faults_.setpointsReach(uav)) return;
    if (quads_[uav].receive(trajectory)) return;
    watch_.refuse("trajectory of " + mission_.scenario.uavs[uav].name, InputFault::kFromFuture,
                  "it begins more than a minute ahead");
  });
}

void QuadSimNode::receiveTracks(const ObstacleTrackArray& message) {
  const TrackBatch batch = convertTracks(message, frames_, toSeconds(message.header.stamp), kJump);
  if (!batch.faults.empty()) watch_.refuse(kTracks, batch.dropped, batch.faults.front());
  for (const TrackedObstacle& track : batch.tracks) {
    const auto known = std::find_if(obstacles_.begin(), obstacles_.end(), [&track](const TrackedObstacle& obstacle) {
      return obstacle.shape.id() == track.shape.id();
    });
    if (known != obstacles_.end()) *known = track;
  }
}

void QuadSimNode::receiveStatus(const PlannerStatus& status) {
  if (!status.started) {
    time_zero_.reset();
    monitor_.reset();
    return;
  }
  const double time_zero = toSeconds(status.time_zero);
  const double cycle_time = status.cycle_time;
  if (!(time_zero > 0.0 && time_zero < time_ + kMostAhead && cycle_time >= 0.0 && cycle_time < kLongestCycle)) {
    watch_.refuse(kStatus, InputFault::kAbsurd, "its t = 0 or its cycle time cannot be");
    return;
  }
  watch_.accept(kStatus);
  if (time_zero_ != time_zero) {
    time_zero_ = time_zero;
    monitor_.emplace(mission_);
    faults_.scheduleScenario(time_zero);
    cycles_ = 0;
    cycle_time_sum_ = 0.0;
    cycle_time_max_ = 0.0;
    clear_ = false;
    ROS_INFO_THROTTLE(kNewsPeriod, "Run of '%s' starts at %.2f s", mission_.scenario.name.c_str(), time_zero);
  }
  ++cycles_;
  cycle_time_sum_ += cycle_time;
  cycle_time_max_ = std::max(cycle_time_max_, cycle_time);
  deadline_misses_ = status.deadline_misses;
}

void QuadSimNode::catchUp() {
  const double now = clock_.now();
  if (now < time_ || now - time_ > kJump) restartClock(now);
  while (origin_ + static_cast<double>(steps_ + 1) * kStep <= now) advance();
}

void QuadSimNode::restartClock(double now) {
  if (time_ > 0.0) {
    ROS_WARN("Time jumped by %.2f s: every UAV holds its position", now - time_);
    monitor_.reset();
    time_zero_.reset();
  }
  origin_ = now;
  steps_ = 0;
  time_ = now;
  next_odometry_ = now;
  faults_.clear();
  for (std::size_t uav = 0; uav < quads_.size(); ++uav) {
    trajectory_links_[uav].clear();
    odometry_links_[uav].clear();
    quads_[uav].resetClock(now);
  }
}

void QuadSimNode::advance() {
  ++steps_;
  time_ = origin_ + static_cast<double>(steps_) * kStep;
  faults_.advanceTo(time_);
  if (time_zero_ && steps_ % kExternalSteps == 0) commandExternals();
  for (std::size_t uav = 0; uav < quads_.size(); ++uav) {
    deliverTrajectories(uav);
    quads_[uav].advanceTo(time_);
    faults_.disturb(uav, quads_[uav]);
  }
  clock_.publish(time_);
  if (time_ >= next_odometry_ - 0.5 * kStep) {
    next_odometry_ += 1.0 / mission_.parameters.simulation.odometry_rate;
    measure();
  }
  for (std::size_t uav = 0; uav < quads_.size(); ++uav) publishOdometry(uav);
  if (monitor_ && time_ >= *time_zero_) observe();
}

void QuadSimNode::commandExternals() {
  for (std::size_t uav = 0; uav < quads_.size(); ++uav) {
    if (externals_[uav]) quads_[uav].receive(externals_[uav]->setpoints(time_, *time_zero_));
  }
}

void QuadSimNode::measure() {
  transforms_.clear();
  for (std::size_t uav = 0; uav < quads_.size(); ++uav) {
    UavMeasurement measurement = quads_[uav].measure();
    QuadState state = quads_[uav].state();
    if (!faults_.spoilOdometry(uav, measurement, state)) continue;
    nav_msgs::Odometry message;
    message.header.stamp = toRosTime(measurement.stamp);
    message.header.frame_id = mission_.scenario.frame_id;
    message.child_frame_id = nameForUav(kBaseLinkFrame, mission_.scenario.uavs[uav].name);
    setPoseAndTwist(measurement, state, message);
    odometry_links_[uav].send(time_, message);

    if (!measurement.p.allFinite()) continue;  // tf2 does not take it
    transforms_.emplace_back();
    transforms_.back().header = message.header;
    transforms_.back().child_frame_id = message.child_frame_id;
    transforms_.back().transform.translation = toVector3Message(toVector3(message.pose.pose.position));
    transforms_.back().transform.rotation = message.pose.pose.orientation;
  }
  broadcaster_.sendTransform(transforms_);
}

void QuadSimNode::publishOdometry(std::size_t uav) {
  odometry_links_[uav].deliver(
      time_, [this, uav](double, const nav_msgs::Odometry& message) { odometry_[uav].publish(message); });
}

void QuadSimNode::observe() {
  for (std::size_t uav = 0; uav < quads_.size(); ++uav) {
    const QuadSimulator& quad = quads_[uav];
    samples_[uav] = {quad.state().p, quad.state().v, quad.trackingError(), quad.setpoint().jerk};
  }
  obstacles_now_.clear();
  for (const TrackedObstacle& obstacle : obstacles_) {
    // Not heard of: where the scenario has it since t = 0.
    const double since = obstacle.stamp > 0.0 ? obstacle.stamp : *time_zero_;
    obstacles_now_.push_back(obstacle.shape.movedBy(time_ - since));
  }
  const double run_time = time_ - *time_zero_;
  if (live_map_) monitor_->setMap(live_map_->map());
  monitor_->observe(run_time, samples_, obstacles_now_);
  if (monitor_->ended()) {
    endRun(monitor_->summary().timed_out ? "timeout" : "scenario");
  } else if (options_.duration > 0.0 && run_time >= options_.duration) {
    endRun("duration");
  }
}

void QuadSimNode::endRun(const std::string& ended_by) {
  RunReport report;
  report.scenario = mission_.scenario.name;
  report.uavs = quads_.size();
  report.ended_by = ended_by;
  report.summary = monitor_->summary();
  report.cycles = cycles_;
  report.cycle_time_mean = cycles_ > 0 ? cycle_time_sum_ / static_cast<double>(cycles_) : 0.0;
  report.cycle_time_max = cycle_time_max_;
  report.deadline_misses = deadline_misses_;
  clear_ = report.clear();
  monitor_.reset();
  ROS_INFO_STREAM(toText(report));
  if (!options_.summary_file.empty()) {
    std::ofstream file(options_.summary_file);
    file << toJson(report) << "\n";
    if (!file) ROS_ERROR("Cannot write the summary to '%s'", options_.summary_file.c_str());
  }
  if (options_.exit_at_end) ros::shutdown();
}

void QuadSimNode::reportIfInterrupted() {
  if (monitor_) endRun("interrupt");
}

}  // namespace swarm_planner
