// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "swarm_planner/experiments/cycle_planner.hpp"
#include "swarm_planner/experiments/run_result.hpp"
#include "swarm_planner/simulation/external_flight.hpp"
#include "swarm_planner/simulation/fault_injector.hpp"
#include "swarm_planner/simulation/message_link.hpp"
#include "swarm_planner/simulation/quad_simulator.hpp"
#include "swarm_planner/simulation/run_monitor.hpp"
#include "swarm_planner/simulation/sensor_clock.hpp"

namespace swarm_planner {

/// Sees a run while it is flown: for recording and for showing progress. Times are relative to t = 0 of the run [s].
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// Every kEvaluationPeriod: the vehicles, and the obstacles where they truly are, in the scenario's order.
  virtual void onSample(double t, const std::vector<QuadSimulator>& vehicles,
                        const std::vector<Superellipsoid>& obstacles) = 0;
  /// After every cycle; `epoch` is that of the plans which it made.
  virtual void onCycle(double epoch, const CycleReport& report) = 0;
};

/// Does more in a run than its scenario says: gives new goals, lets obstacles come again. Times as RunObserver's.
class RunDirector {
 public:
  virtual ~RunDirector() = default;
  /// Before the planner plans at `now`; `restarted`: it is a new one, that has not planned yet.
  virtual void beforeCycle(double now, const std::vector<QuadSimulator>& vehicles, bool restarted) = 0;
  /// For how long obstacle `index` has moved since it was at its start, at time `t` [s].
  virtual double obstacleTime(std::size_t index, double t) const = 0;
};

/// One run: planner and simulated vehicles in closed loop, without ROS, timed as the ROS nodes are.
///
/// Sensors measure at the instants of SensorClock; every message goes over a MessageLink of its own kind and UAV. Every
/// cycle_period the planner gets a snapshot of what has arrived (the newest odometry of each vehicle, the newest tracks
/// of the obstacles) and plans for the epoch one cycle_period later: what one cycle computes is flown from the next on.
/// With as_paper planning takes no time: it plans for the instant of the snapshot.
/// Plans are sampled at kSetpointPeriod and sent to the vehicles, setpoint_repeats times more before the next cycle.
/// The first epoch is t = 0: obstacles are at their start and targets begin to move then. The vehicles hover from t =
/// -cycle_period on, where gusts set in; before that they stand at their start while the first messages are under way.
/// External UAVs fly behind their targets (ExternalFlight); they are measured and count like all others.
///
/// The scenario's faults are injected. While the planner is dead nothing is planned or sent; then it is restarted.
class ClosedLoopRun {
 public:
  /// Distances, collisions and so on are evaluated this often [s].
  static constexpr double kEvaluationPeriod = 0.01;
  /// Spacing of the setpoints that the vehicles receive [s].
  static constexpr double kSetpointPeriod = 0.05;

  /// `mission` and `planner` must outlive the run. `seed` is that of all random disturbances.
  ClosedLoopRun(const Mission& mission, CyclePlanner& planner, std::uint64_t seed);

  /// `director` must outlive the run; nobody directs without.
  void setDirector(RunDirector& director) { director_ = &director; }

  /// Flies until the scenario's end condition holds. Call it once. `observers` are told in the order given.
  RunResult fly(const std::vector<RunObserver*>& observers = {});

 private:
  void moveTo(double t);
  void measureBefore(double t);
  void sendOdometry(double now);
  void sendTracks(double now);
  void receiveMeasurements(double now);
  void receiveTrack(const TrackedObstacle& track);
  double obstacleTime(std::size_t index, double t) const;
  void planCycle(double now, double epoch, const std::vector<RunObserver*>& observers);
  /// To every vehicle that the last cycle left a motion to fly, and to those that another system flies.
  void sendSetpoints(double now);
  void receiveSetpoints(std::size_t uav, double now);
  void record(const CycleReport& report);
  void evaluate(double t, const std::vector<RunObserver*>& observers);
  void summarise();

  const Mission& mission_;
  CyclePlanner& planner_;
  std::vector<QuadSimulator> vehicles_;
  std::vector<std::optional<ExternalFlight>> externals_;  ///< of the vehicles that another system flies
  std::vector<Superellipsoid> obstacles_at_start_;
  std::vector<Superellipsoid> obstacles_;
  double time_;  ///< of vehicles and obstacles [s]
  SensorClock odometry_clock_, track_clock_;
  std::vector<MessageLink<UavMeasurement>> odometry_links_;      ///< one per UAV
  std::vector<MessageLink<SetpointTrajectory>> setpoint_links_;  ///< one per UAV
  MessageLink<std::vector<TrackedObstacle>> track_link_;
  RunMonitor monitor_;
  Snapshot snapshot_;
  const CycleReport* report_ = nullptr;  ///< of the last cycle; null while the planner is dead
  bool restart_due_ = false;             ///< the planner has died
  FaultInjector faults_;
  RandomStream records_;  ///< which planners that die leave a record
  RunDirector* director_ = nullptr;
  SetpointTrajectory setpoints_;
  std::vector<UavSample> samples_;

  RunResult result_;
  std::vector<double> cycle_ms_;
  std::vector<double> cycle_cpu_ms_;
  std::vector<double> uav_ms_;
  std::vector<double> sqp_iterations_;
  std::vector<double> qp_iterations_;
};

}  // namespace swarm_planner
