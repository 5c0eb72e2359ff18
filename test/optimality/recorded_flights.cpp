// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "optimality/recorded_flights.hpp"

#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/planner_limits.hpp"
#include "swarm_planner/swarm/surroundings.hpp"

namespace swarm_planner {
namespace {

/// Shows the programs of a cycle before it has them solved.
class RecordingPlanner : public CyclePlanner {
 public:
  RecordingPlanner(const Mission& mission, int stride, const std::function<void(const MetProgram&)>& visit)
      : mission_(mission),
        planner_(mission),
        surroundings_(mission.parameters, mission.scenario.uavs.size(), mission.scenario.obstacles.size()),
        stride_(stride),
        visit_(visit) {}

  const CycleReport& plan(const Snapshot& snapshot, double epoch) override {
    // The first plan has no motion to go on from.
    if (++cycle_ > 1 && cycle_ % stride_ == 0) showAll(snapshot, epoch);
    planner_.searchGuides();
    return planner_.plan(snapshot, epoch);
  }
  const CommittedMotion& committed(std::size_t uav) const override { return planner_.committed(uav); }

 private:
  void showAll(const Snapshot& snapshot, double epoch) {
    surroundings_.setEpoch(epoch);
    surroundings_.setObstacles(snapshot.obstacles, snapshot.now);
    for (std::size_t i = 0; i < snapshot.uavs.size(); ++i) {
      surroundings_.setMotions(i, committed(i), nullptr);
      surroundings_.setPlanning(i, committed(i).at(epoch));
    }
    surroundings_.findNeighbours();
    for (std::size_t i = 0; i < snapshot.uavs.size(); ++i) {
      if (planner_.guide(i) == nullptr) show(i, snapshot.uavs[i], epoch);
    }
  }

  void show(std::size_t uav, const UavMeasurement& measured, double epoch) {
    constexpr double kBefore = 1e-6;  // [s]
    const Parameters& parameters = mission_.parameters;
    const MovingTarget& target = planner_.reference(uav);
    UavProblem problem;
    problem.parameters = &parameters;
    problem.path = &target.path;
    problem.bounds = solverBounds(
        makeCheckLimits(parameters, mission_.scenario.workspace ? &*mission_.scenario.workspace : nullptr).bounds);
    problem.dt = parameters.time.sampling_time;
    problem.epoch = epoch;
    problem.start = committed(uav).at(epoch);
    if (parameters.limits.as_paper) problem.start = {measured.p, measured.v, committed(uav).at(epoch - kBefore).a};
    problem.progress = target.path.nearest(problem.start.p, 0.0, 1e9).arc_length;
    problem.targets = previewTargets(target, problem.progress, parameters.limits.max_speed, epoch, problem.dt);
    surroundings_.collect(uav, problem);
    Trajectory guess;
    guess.holds_acceleration = parameters.limits.as_paper;
    shiftPlan(committed(uav), problem.start, epoch, problem.dt, guess);
    visit_({problem, guess, uav, epoch});
  }

  const Mission& mission_;
  SwarmPlanner planner_;
  Surroundings surroundings_;
  int stride_;
  const std::function<void(const MetProgram&)>& visit_;
  int cycle_ = 0;
};

}  // namespace

void visitPrograms(const Mission& mission, int stride, const std::function<void(const MetProgram&)>& visit) {
  RecordingPlanner planner(mission, stride, visit);
  ClosedLoopRun(mission, planner, 0).fly();
}

}  // namespace swarm_planner
