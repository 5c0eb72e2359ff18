// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/closed_loop_run.hpp"

#include <limits>

#include "swarm_planner/experiments/kkt_nonzeros.hpp"

namespace swarm_planner {
namespace {

constexpr double kSecondsToMilliseconds = 1000.0;

MeanMax meanMax(const std::vector<double>& samples) {
  const Distribution distribution = distributionOf(samples);
  return {distribution.mean, distribution.max};
}

/// The sensor noise of each UAV and run has a stream of its own.
std::uint64_t noiseSeed(std::uint64_t run_seed, std::size_t uav) { return (run_seed << 24) + uav; }

bool isFallback(const UavReport& report) {
  return report.state == UavState::kFallback || report.reason == Reason::kSolverFailed ||
         report.reason == Reason::kConstraintsViolated;
}

}  // namespace

ClosedLoopRun::ClosedLoopRun(const Mission& mission, CyclePlanner& planner, std::uint64_t seed)
    : mission_(mission), planner_(planner), monitor_(mission) {
  const Scenario& scenario = mission.scenario;
  for (std::size_t i = 0; i < scenario.uavs.size(); ++i) {
    vehicles_.emplace_back(mission.parameters, scenario.uavs[i].start, noiseSeed(seed, i));
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) obstacles_at_start_.push_back(makeObstacle(obstacle));
  obstacles_ = obstacles_at_start_;
  samples_.resize(vehicles_.size());
  snapshot_.uavs.resize(vehicles_.size());
  snapshot_.obstacles.resize(obstacles_.size());
  result_.scenario = scenario.name;
  result_.seed = seed;
  result_.uavs = vehicles_.size();
  result_.kkt_nonzeros = kktNonzeros(mission);
}

RunResult ClosedLoopRun::fly(const std::vector<RunObserver*>& observers) {
  constexpr double kSameInstant = 1e-9;  // [s]
  const double period = mission_.parameters.time.cycle_period;
  long long cycle = -1;  // the one whose plans begin at t = 0
  long long evaluation = 0;
  while (!monitor_.ended()) {
    // Both from counters: a sum of periods would drift.
    const double cycle_time = static_cast<double>(cycle) * period;
    const double evaluation_time = static_cast<double>(evaluation) * kEvaluationPeriod;
    if (cycle_time < evaluation_time - kSameInstant) {
      planCycle(cycle_time, static_cast<double>(cycle + 1) * period, observers);
      ++cycle;
    } else {
      evaluate(evaluation_time, observers);
      ++evaluation;
    }
  }
  summarise();
  return result_;
}

void ClosedLoopRun::moveTo(double t) {
  for (QuadSimulator& vehicle : vehicles_) vehicle.advanceTo(t);
  for (std::size_t i = 0; i < obstacles_.size(); ++i) obstacles_[i] = obstacles_at_start_[i].movedBy(t);
}

void ClosedLoopRun::planCycle(double now, double epoch, const std::vector<RunObserver*>& observers) {
  moveTo(now);
  snapshot_.now = now;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) snapshot_.uavs[i] = vehicles_[i].measure();
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    snapshot_.obstacles[i].shape = obstacles_[i];
    snapshot_.obstacles[i].stamp = now;
  }
  const CycleReport& report = planner_.plan(snapshot_, epoch);
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    if (!report.uavs[i].planned) continue;
    samplePlan(planner_.committed(i), kSetpointPeriod, std::numeric_limits<double>::infinity(), 0.0, setpoints_);
    if (!vehicles_[i].receive(setpoints_)) ++result_.fallbacks["the vehicle refused the trajectory"];
  }
  record(report);
  for (RunObserver* observer : observers) observer->onCycle(epoch, report);
}

void ClosedLoopRun::record(const CycleReport& report) {
  ++result_.cycles;
  cycle_ms_.push_back(kSecondsToMilliseconds * report.cycle_time);
  if (report.cycle_time > mission_.parameters.time.cycle_period) ++result_.deadline_misses;
  for (const UavReport& uav : report.uavs) {
    if (isFallback(uav)) ++result_.fallbacks[reasonText(uav.reason)];
    if (uav.sqp_iterations == 0) continue;  // nothing was solved for it
    uav_ms_.push_back(kSecondsToMilliseconds * uav.solve_time);
    sqp_iterations_.push_back(uav.sqp_iterations);
    qp_iterations_.push_back(uav.qp_iterations);
  }
}

void ClosedLoopRun::evaluate(double t, const std::vector<RunObserver*>& observers) {
  moveTo(t);
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const MotionSetpoint setpoint = vehicles_[i].setpoint();
    samples_[i].p = vehicles_[i].state().p;
    samples_[i].v = vehicles_[i].state().v;
    samples_[i].tracking_error = (setpoint.p - samples_[i].p).norm();
    samples_[i].jerk = setpoint.jerk;
  }
  monitor_.observe(t, samples_, obstacles_);
  for (RunObserver* observer : observers) observer->onSample(t, vehicles_, obstacles_);
}

void ClosedLoopRun::summarise() {
  result_.cycle_ms = distributionOf(cycle_ms_);
  result_.uav_ms = distributionOf(uav_ms_);
  result_.sqp_iterations = meanMax(sqp_iterations_);
  result_.qp_iterations = meanMax(qp_iterations_);
  result_.flown = monitor_.summary();
}

}  // namespace swarm_planner
