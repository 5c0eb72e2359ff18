// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/problem/map_corridor.hpp"
#include "swarm_planner/problem/reference_path.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/cycle_report.hpp"
#include "swarm_planner/swarm/flight_task.hpp"
#include "swarm_planner/swarm/followed_target.hpp"
#include "swarm_planner/swarm/following_watch.hpp"
#include "swarm_planner/swarm/guided_flight.hpp"
#include "swarm_planner/swarm/motion_doubt.hpp"
#include "swarm_planner/swarm/motion_memory.hpp"
#include "swarm_planner/swarm/odometry_monitor.hpp"
#include "swarm_planner/swarm/plan_check.hpp"
#include "swarm_planner/swarm/takeover.hpp"
#include "swarm_planner/swarm/traffic_state.hpp"

namespace swarm_planner {

/// What is kept of one UAV from cycle to cycle.
struct UavRecord {
  std::string name;
  MovingTarget reference;
  double given_start = 0.0;       ///< of the reference as it was given: pauses move reference.start on [m]
  bool reference_pending = true;  ///< its time zero is the next epoch
  bool on_reference = false;      ///< progress holds
  double progress = 0.0;          ///< arc length of the foot of the last start [m]
  MotionMemory motions;           ///< a rest where it was measured before its first plan
  bool planned = false;           ///< the newest motion comes from a plan
  Beginning beginning;            ///< how it comes to be planned for
  KinematicState start;           ///< of the plan in work, at its epoch
  /// From what it is to fly, as measured; the mean over some cycles, in which noise is averaged [m].
  Vector3 deviation = Vector3::Zero();
  FlightTask task;          ///< what it is to do, as commands left it
  TrafficState traffic;     ///< towards other UAVs
  GuidedFlight guide;       ///< round what blocks what it follows
  CorridorMemory corridor;  ///< the free space of its last plan, where there is a map
  ActiveRows active;        ///< of the last QP, at `active_epoch`
  double active_epoch = 0.0;
  OdometryMonitor monitor;
  bool foreign = false;  ///< another system flies it
  bool unseen = false;   ///< its odometry could not be planned from in the last cycle, or it has joined since
  FollowingWatch following;
  /// A stop from where it was seen last, which it may fly instead of its motion: it was not on that.
  std::optional<CommittedMotion> aside;
  bool evades = false;             ///< it has a new motion since it was seen last
  bool off_plan = false;           ///< planned for anew in this cycle: it was far off its motion for long
  double off_plan_distance = 0.0;  ///< so far [m]

  void setReference(const std::vector<Vector3>& path, double arc_length, double speed);
  /// The target stays where it is at `t` [s], until its time zero is set anew.
  void pauseReference(double t) {
    if (!reference_pending) reference.start = reference.at(t).arc_length;
    reference_pending = true;
  }
  /// Forgets all motions, and with them what it holds at; the reference starts anew. Its mode stays.
  void reset();
  /// Takes the measurement in: what the UAV flies, and where it will be at `epoch`. Where it is not on its motion, its
  /// plan starts from the measurement, and until there is one it is to brake. `bounds`: that a stop should keep.
  void predictStart(const UavMeasurement& measurement, double epoch, const Parameters& parameters,
                    const FlightBounds& bounds);
  /// From the next cycle on another system flies it, or this one again.
  void setForeign(bool is_foreign);
  /// Whether it may still fly what it was to fly, as measured: near it, and that has not ended.
  bool isOnMotion(const UavMeasurement& measurement, const Parameters& parameters) const;
  void forgetMotions();
  /// Its odometry cannot be planned from in this cycle.
  void loseSight(const Parameters& parameters, const FlightBounds& bounds);
  /// In what way it is not where it was to be, for the operator; kNone where it is.
  Reason reasonOff(const Parameters& parameters) const;
  /// How far it may be from its motion while it is not seen.
  MotionDoubt doubt(const InputParameters& input) const;

 private:
  /// Others keep clear of it from the measured state on, too.
  void setAside(const KinematicState& measured, double epoch, const Parameters& parameters, const FlightBounds& bounds);
  void startAnew(const KinematicState& measured, double epoch, const Parameters& parameters,
                 const FlightBounds& bounds);
};

}  // namespace swarm_planner
