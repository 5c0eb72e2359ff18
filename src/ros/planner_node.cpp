// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/planner_node.hpp"

#include <ros/console.h>
#include <ros/time.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "swarm_planner/ros/geometry_conversion.hpp"
#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"
#include "swarm_planner/ros/status_conversion.hpp"
#include "swarm_planner/ros/status_tally.hpp"
#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

// ROS time that goes back by less is waited for [s].
constexpr double kLeastTimeJump = 1.0;
// Between two messages about answers to services: a new reference for every UAV of a swarm is not news for each [s].
constexpr double kServicePeriod = 0.1;
// Names in one message.
constexpr std::size_t kMostNames = 12;

std::vector<std::string> namesOf(const SwarmPlanner& planner) {
  std::vector<std::string> names;
  for (std::size_t uav = 0; uav < planner.uavCount(); ++uav) names.push_back(planner.uavName(uav));
  return names;
}

// A line for each UAV that has a reason, with an alarm or without; of a large swarm the first.
std::string reasonsOf(const PlannerStatus& status, bool alarm) {
  std::string text;
  std::size_t uavs = 0;
  for (const UavStatus& uav : status.uavs) {
    if (uav.reason.empty() || concernOf(uav) == Concern::kNone || static_cast<bool>(uav.alarm) != alarm) continue;
    if (++uavs <= kMostNames) text += "\n  " + uav.name + ": " + uav.reason;
  }
  return uavs > kMostNames ? text + "\n  and " + std::to_string(uavs - kMostNames) + " more" : text;
}

InputParameters inputLimits(const Mission& mission) {
  InputParameters limits = mission.parameters.input;
  limits.max_tracks = static_cast<int>(maxTracks(mission));
  return limits;
}

// One period ahead of the time at which the timer should have fired, which keeps epochs equidistant however late the
// callback comes; one period ahead of `now` if that grid does not fit (a late cycle, a jump of time).
double epochFor(double expected, double now, double period) {
  const double epoch = expected + period;
  const bool fits = epoch >= now && epoch <= now + period;
  return fits ? epoch : now + period;
}

}  // namespace

PlannerNode::PlannerNode(SwarmPlanner planner, const Mission& mission, const PlannerNodeOptions& options)
    : planner_(std::move(planner)),
      guides_(planner_),
      names_(namesOf(planner_)),
      frame_(options.planning_frame.empty() ? mission.scenario.frame_id : options.planning_frame),
      cycle_period_(mission.parameters.time.cycle_period),
      setpoint_repeats_(mission.parameters.input.setpoint_repeats),
      inputs_(names_, frame_, options, inputLimits(mission)),
      map_markers_(mission, frame_, options.map),
      maps_(
          mission, options.map, inputs_.frames(), [this](double t) { return inputs_.store().placesAt(t); },
          [this](const VoxelMap& map) { map_markers_.show(map); }),
      outputs_(names_, frame_, options),
      diagnostics_(names_, cycle_period_, mission.parameters.input.track_timeout),
      markers_(mission, frame_, options, inputs_, maps_),
      track_timeout_(mission.parameters.input.track_timeout),
      budget_(options.planning_share),
      commands_(names_, planner_, [this] { keepModes(); }) {
  if (options.setpoint_horizon < 2.0 * cycle_period_) {
    ROS_WARN("setpoint_horizon is %.2f s: vehicles run out of setpoints when one cycle of %.2f s is lost",
             options.setpoint_horizon, cycle_period_);
  }
  openRecord(options.flight_record, mission);
  advertiseServices();
  ros::NodeHandle node;
  cycle_timer_ = node.createTimer(ros::Duration(cycle_period_), &PlannerNode::runCycle, this);
  repeat_timer_ = node.createTimer(ros::Duration(cycle_period_ / (1 + setpoint_repeats_)),
                                   &PlannerNode::repeatSetpoints, this, false, false);
  diagnostics_timer_ = node.createWallTimer(ros::WallDuration(options.diagnostic_period),
                                            [this](const ros::WallTimerEvent&) { reportHealth(); });
  ROS_INFO("Planning for %zu UAVs of '%s' in frame '%s' every %.2f s", names_.size(), mission.scenario.name.c_str(),
           frame_.c_str(), cycle_period_);
}

void PlannerNode::runCycle(const ros::TimerEvent& event) {
  const double now = toSeconds(ros::Time::now());
  if (now < last_now_) {
    // A clock that trembles, or a second one that repeats the first: what is asked for until it has caught up is
    // planned.
    if (now > last_now_ - kLeastTimeJump) return;
    resetAfterTimeJump(now);
  }
  last_now_ = now;
  if (!has_cycled_) takeOver(now);
  has_cycled_ = true;
  const double epoch = epochFor(toSeconds(event.current_expected), now, cycle_period_);
  // After a late cycle the timer catches up; what it asks for has been planned.
  if (epoch < last_epoch_ + 0.5 * cycle_period_) return;
  last_epoch_ = epoch;
  if (ros::Time::isSimTime()) budget_.noteCycle(now, ros::SteadyTime::now().toSec());
  outputs_.sendWaitingSetpoints();
  inputs_.store().fill(now, snapshot_);
  snapshot_.map = maps_.map();
  snapshot_.now = std::min(snapshot_.now, epoch);
  planner_.plan(snapshot_, epoch, budget_.forPlansDueIn(epoch - toSeconds(ros::Time::now())));
  guides_.wake();
  const bool deadline_missed = toSeconds(ros::Time::now()) > epoch;
  publishCycle(now, deadline_missed);
  startRepeats();
}

void PlannerNode::startRepeats() {
  repeat_timer_.stop();
  repeats_left_ = setpoint_repeats_;
  if (repeats_left_ > 0) repeat_timer_.start();
}

void PlannerNode::repeatSetpoints(const ros::TimerEvent&) {
  outputs_.repeatSetpoints();
  if (--repeats_left_ <= 0) repeat_timer_.stop();
}

void PlannerNode::publishCycle(double now, bool deadline_missed) {
  const std::vector<UavInput> uavs = inputs_.store().uavs();
  keepModes();
  if (record_) record_->write(planner_, inputs_.store().tracks().known, now, ros::WallTime::now().toSec());
  outputs_.publishPlans(planner_, uavs, now);

  deadline_misses_ += deadline_missed ? 1 : 0;
  std::vector<std::string> reasons;
  for (std::size_t uav = 0; uav < names_.size(); ++uav) {
    reasons.push_back(describeReason(planner_, uav, uavs, inputs_.odometryTopic(uav)));
    rejected_plans_ += planner_.report().uavs[uav].refusal != CheckReason::kAccepted ? 1 : 0;
  }
  toMessage(planner_, {now, frame_, deadline_missed, deadline_misses_, rejected_plans_}, reasons, status_);
  outputs_.publishStatus(status_);
  diagnostics_.addCycle(status_);
  markers_.update(planner_, status_);
  if (deadline_missed) {
    ROS_WARN_THROTTLE(kWarningPeriod, "Cycle missed its deadline: planning took %.0f ms (%u so far)",
                      1e3 * status_.cycle_time, deadline_misses_);
  }
  tellOperator();
}

void PlannerNode::tellOperator() const {
  const std::string alarms = reasonsOf(status_, true);
  const std::string warnings = reasonsOf(status_, false);
  if (!alarms.empty()) ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, "ALARM, safety is not assured:" << alarms);
  if (!warnings.empty()) ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "Not every UAV is tracking:" << warnings);
}

void PlannerNode::resetAfterTimeJump(double now) {
  if (clock_.noteJumpBack(ros::SteadyTime::now().toSec())) {
    ROS_WARN("ROS time jumped back by %.2f s: plans and inputs are forgotten, the run starts anew", last_now_ - now);
  }
  last_epoch_ = 0.0;
  planner_.reset();
  if (record_) record_->forgetMotions();
  inputs_.store().clear();
  outputs_.clear();
  diagnostics_.restart();
  markers_.clear();
}

void PlannerNode::advertiseServices() {
  ros::NodeHandle private_node("~");
  set_reference_server_ = advertiseGuarded<SetReference>(
      private_node, kSetReferenceService, kMostReferenceBytes,
      [this](SetReference::Request& request, SetReference::Response& response) {
        return setReference(request, response);
      },
      [this](InputFault, const std::string& why, SetReference::Response& response) { refuseReference(why, response); });
}

bool PlannerNode::setReference(SetReference::Request& request, SetReference::Response& response) {
  try {
    const std::size_t uav = uavIndex(request.uav);
    const UavOrders::Reference reference{pathInPlanningFrame(request), request.start, request.speed};
    planner_.setReference(uav, reference.path, reference.start, reference.speed);
    diagnostics_.addReference(true);
    response.success = true;
    response.message = request.uav + " follows the new reference from the next epoch on";
    const FlightMode mode = planner_.mode(uav);
    if (mode != FlightMode::kFlying) {
      response.message = request.uav + " is " + modeText(mode) + ": it follows the new reference once it flies";
    }
    if (record_ && !record_->setReference(uav, reference)) {
      response.message += "; it could not be written to the flight's record: a planner restarted will not know of it";
    }
    ROS_INFO_STREAM_THROTTLE(kServicePeriod, response.message);
  } catch (const std::invalid_argument& error) {
    refuseReference(error.what(), response);
  }
  return true;  // false would drop the message that says why
}

void PlannerNode::refuseReference(const std::string& why, SetReference::Response& response) {
  diagnostics_.addReference(false);
  response.success = false;
  response.message = why;
  ROS_WARN_STREAM_THROTTLE(kServicePeriod, "set_reference refused: " << why);
}

std::vector<Vector3> PlannerNode::pathInPlanningFrame(const SetReference::Request& request) const {
  std::string why;
  const auto pose = inputs_.frames().toPlanning(request.header.frame_id, request.header.stamp, why);
  if (!pose) throw std::invalid_argument(why);
  std::vector<Vector3> path;
  for (const geometry_msgs::Point& point : request.path) path.push_back(*pose * toVector3(point));
  return path;
}

std::size_t PlannerNode::uavIndex(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  std::string known;
  for (std::size_t i = 0; i < std::min(kMostNames, names_.size()); ++i) known += (i == 0 ? "" : ", ") + names_[i];
  if (names_.size() > kMostNames) known += " and " + std::to_string(names_.size() - kMostNames) + " more";
  throw std::invalid_argument("no UAV is called '" + shortened(name) + "'; there are: " + known);
}

}  // namespace swarm_planner
