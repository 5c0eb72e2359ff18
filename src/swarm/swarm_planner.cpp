// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/swarm_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "swarm_planner/solver/interior_point.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"
#include "swarm_planner/swarm/surroundings.hpp"

namespace swarm_planner {
namespace {

constexpr double kClockTolerance = 0.05;  // odometry stamped later than this is from the future [s]
/// Constraints met to a micrometre: what the solver leaves is far below the tracking margin.
constexpr InteriorPointSolver::Settings kSolverSettings{40, 1e-6, 1e-6};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What the planner keeps of one UAV between cycles.
struct Uav {
  std::string name;
  MovingTarget reference;
  bool reference_pending = true;  ///< its time zero is the next epoch
  bool on_reference = false;      ///< progress holds
  double progress = 0.0;          ///< arc length of the foot of the last start [m]
  int plans = 0;                  ///< how many of committed, previous hold
  Trajectory committed;
  Trajectory previous;
};

/// Why a measurement cannot be planned from; kNone if it can.
Reason judge(const UavMeasurement& measurement, double now, double timeout) {
  if (!measurement.received) return Reason::kWaitingForOdometry;
  if (!measurement.p.allFinite() || !measurement.v.allFinite() || !std::isfinite(measurement.stamp)) {
    return Reason::kOdometryNotFinite;
  }
  if (measurement.stamp > now + kClockTolerance) return Reason::kOdometryFromFuture;
  if (now - measurement.stamp > timeout) return Reason::kOdometryStale;
  return Reason::kNone;
}

MovingTarget makeTarget(const std::vector<Vector3>& path, double start, double speed) {
  MovingTarget target;
  target.path = ReferencePath(path);
  target.start = start;
  target.speed = speed;
  return target;
}

}  // namespace

class SwarmPlanner::Impl {
 public:
  explicit Impl(const Mission& mission)
      : parameters(mission.parameters),
        workspace(mission.scenario.workspace),
        surroundings(parameters, mission.scenario.uavs.size()),
        sqp(std::make_unique<InteriorPointSolver>(kSolverSettings)),
        judged(mission.scenario.uavs.size()) {
    for (const ScenarioUav& scenario_uav : mission.scenario.uavs) {
      Uav uav;
      uav.name = scenario_uav.name;
      uav.reference = makeTarget(scenario_uav.reference, scenario_uav.target.start, scenario_uav.target.speed);
      uavs.push_back(std::move(uav));
    }
    report.uavs.resize(uavs.size());
    problem.parameters = &parameters;
    problem.dt = parameters.time.sampling_time;
    problem.bodies.reserve(uavs.size() + mission.scenario.obstacles.size());
  }

  void plan(const Snapshot& snapshot, double epoch) {
    const Stopwatch stopwatch;
    ++report.cycle;
    report.epoch = epoch;
    judgeMeasurements(snapshot);
    if (!report.started && mayStart(snapshot)) {
      report.started = true;
      report.time_zero = epoch;
    }
    if (report.started) planAll(snapshot, epoch);
    report.cycle_time = stopwatch.elapsed();
  }

  void reset() {
    report.started = false;
    for (Uav& uav : uavs) {
      uav.plans = 0;
      uav.reference_pending = true;
      uav.on_reference = false;
    }
  }

  Parameters parameters;
  std::optional<Workspace> workspace;
  std::vector<Uav> uavs;
  CycleReport report;

 private:
  void judgeMeasurements(const Snapshot& snapshot) {
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      const UavMeasurement none;
      judged[i] =
          judge(i < snapshot.uavs.size() ? snapshot.uavs[i] : none, snapshot.now, parameters.input.odometry_timeout);
      UavReport& uav_report = report.uavs[i];
      uav_report = UavReport();
      uav_report.obstacle_clearance = uav_report.pair_distance = kInfinity;
      uav_report.state = report.started && judged[i] != Reason::kNone ? UavState::kLost : UavState::kHolding;
      uav_report.reason = judged[i];
      if (judged[i] == Reason::kNone && !report.started) {
        uav_report.reason = parameters.input.autostart ? Reason::kWaitingForOthers : Reason::kWaitingForStart;
      }
    }
  }

  bool mayStart(const Snapshot& snapshot) const {
    const bool all_arrived = snapshot.uavs.size() == uavs.size() &&
                             std::all_of(judged.begin(), judged.end(), [](Reason r) { return r == Reason::kNone; });
    return parameters.input.autostart && all_arrived;
  }

  void planAll(const Snapshot& snapshot, double epoch) {
    surroundings.setObstacles(snapshot.obstacles, snapshot.now, epoch);
    surroundings.clearUavs();
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if (uavs[i].plans > 0) {
        surroundings.setPlan(i, uavs[i].committed, epoch);
      } else if (judged[i] == Reason::kNone) {
        surroundings.setResting(i, snapshot.uavs[i].p);
      }
    }
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if (uavs[i].reference_pending) uavs[i].reference.time_zero = epoch;
      uavs[i].reference_pending = false;
      if (judged[i] == Reason::kNone) planUav(i, snapshot.uavs[i], epoch);
    }
  }

  void planUav(std::size_t i, const UavMeasurement& measurement, double epoch) {
    const Stopwatch stopwatch;
    Uav& uav = uavs[i];
    UavReport& uav_report = report.uavs[i];
    poseProblem(i, measurement, epoch);
    if (uav.plans > 0) {
      shiftPlan(uav.committed, problem.start, epoch, problem.dt, plan_in_work);
    } else {
      coastingPlan(problem.start, epoch, problem.dt, plan_in_work);
    }
    const SqpResult result = sqp.solve(problem, plan_in_work);
    uav_report.sqp_iterations = result.iterations;
    uav_report.qp_iterations = result.qp_iterations;
    uav_report.max_slack = result.max_violation;
    uav_report.lag = problem.targets[0].arc_length - uav.progress;
    const PredictedClearance clearance = predictedClearance(problem, plan_in_work);
    uav_report.obstacle_clearance = clearance.obstacle;
    uav_report.pair_distance = clearance.pair;
    if (result.solved) {
      commit(i, epoch);
    } else {
      uav_report.reason = Reason::kSolverFailed;
    }
    uav_report.planned = uav.plans > 0;
    uav_report.state = uav_report.planned ? UavState::kTracking : UavState::kHolding;
    if (result.solved) uav_report.reason = Reason::kNone;
    if (result.max_violation > parameters.limits.tracking_margin) uav_report.reason = Reason::kConstraintsViolated;
    if (uav_report.reason != Reason::kNone) uav_report.state = UavState::kFallback;
    uav_report.solve_time = stopwatch.elapsed();
  }

  void poseProblem(std::size_t i, const UavMeasurement& measurement, double epoch) {
    Uav& uav = uavs[i];
    problem.epoch = epoch;
    problem.path = &uav.reference.path;
    if (uav.plans > 0) {
      const bool flown_is_committed = uav.plans == 1 || measurement.stamp >= uav.committed.epoch;
      problem.start = predictFromPlan(uav.committed, flown_is_committed ? uav.committed : uav.previous, measurement,
                                      epoch, parameters.input.tracking_time);
    } else {
      problem.start = predictFromMeasurement(measurement, epoch);
    }
    const PathPoint foot = uav.on_reference ? uav.reference.path.nearest(problem.start.p, uav.progress)
                                            : uav.reference.path.nearest(problem.start.p, 0.0, kInfinity);
    uav.progress = problem.progress = foot.arc_length;
    uav.on_reference = true;
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      problem.targets[k] = uav.reference.at(epoch + static_cast<double>(k) * problem.dt);
    }
    problem.bounds = FlightBounds(parameters, workspace ? &*workspace : nullptr);
    surroundings.collect(i, problem);
  }

  void commit(std::size_t i, double epoch) {
    Uav& uav = uavs[i];
    uav.previous = uav.committed;
    uav.committed = plan_in_work;
    uav.plans = std::min(uav.plans + 1, 2);
    surroundings.setPlan(i, uav.committed, epoch);
  }

  Surroundings surroundings;
  SqpSolver sqp;
  UavProblem problem;
  Trajectory plan_in_work;
  std::vector<Reason> judged;  ///< of each UAV's measurement in this cycle
};

SwarmPlanner::SwarmPlanner(const Mission& mission) : impl_(std::make_unique<Impl>(mission)) {}
SwarmPlanner::~SwarmPlanner() = default;
SwarmPlanner::SwarmPlanner(SwarmPlanner&&) noexcept = default;
SwarmPlanner& SwarmPlanner::operator=(SwarmPlanner&&) noexcept = default;

std::size_t SwarmPlanner::uavCount() const { return impl_->uavs.size(); }
const std::string& SwarmPlanner::uavName(std::size_t uav) const { return impl_->uavs[uav].name; }

const CycleReport& SwarmPlanner::plan(const Snapshot& snapshot, double epoch) {
  impl_->plan(snapshot, epoch);
  return impl_->report;
}

const CycleReport& SwarmPlanner::report() const { return impl_->report; }
const Trajectory& SwarmPlanner::committed(std::size_t uav) const { return impl_->uavs[uav].committed; }

TargetState SwarmPlanner::target(std::size_t uav, double t) const {
  const MovingTarget& reference = impl_->uavs[uav].reference;
  return reference.at(impl_->uavs[uav].reference_pending ? reference.time_zero : t);
}

const MovingTarget& SwarmPlanner::reference(std::size_t uav) const { return impl_->uavs[uav].reference; }

void SwarmPlanner::setReference(std::size_t uav, const std::vector<Vector3>& path, double start, double speed) {
  if (uav >= impl_->uavs.size()) throw std::invalid_argument("there is no UAV " + std::to_string(uav));
  if (path.empty()) throw std::invalid_argument("the path has no point");
  if (!std::all_of(path.begin(), path.end(), [](const Vector3& point) { return point.allFinite(); })) {
    throw std::invalid_argument("the path has a point that is not finite");
  }
  if (!(start >= 0.0) || !std::isfinite(start)) throw std::invalid_argument("start must be finite and >= 0");
  if (!(speed >= 0.0) || !std::isfinite(speed)) throw std::invalid_argument("speed must be finite and >= 0");
  Uav& target = impl_->uavs[uav];
  target.reference = makeTarget(path, start, speed);
  target.reference_pending = true;
  target.on_reference = false;
}

void SwarmPlanner::reset() { impl_->reset(); }

}  // namespace swarm_planner
