// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What the parts of a planning cycle take. Run it on a quiet machine:
//   .build/devel/lib/swarm_planner/benchmark_cycle --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
// Every part handles all UAVs of a swarm, one after the other on one thread; `per_uav` is its share.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "swarm/perfect_flight.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/solve_order.hpp"
#include "swarm_planner/swarm/surroundings.hpp"

namespace swarm_planner {
namespace {

/// The swarm is among its obstacles by then: 60 cycles are 18 s.
constexpr int kCyclesFlown = 60;

/// Everything that the UAVs of a swarm meet in one cycle in the middle of a flight.
class MidFlight {
 public:
  explicit MidFlight(int uavs)
      : mission_(makeMission(paperScaling(uavs), {}, "paper")),
        flight_(mission_),
        surroundings_(mission_.parameters, mission_.scenario.uavs.size(), mission_.scenario.obstacles.size()) {
    flight_.cycles(kCyclesFlown);
    epoch_ = flight_.now();
    std::vector<TrackedObstacle> tracks(mission_.scenario.obstacles.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      tracks[i].shape = flight_.obstacle(i, epoch_);
      tracks[i].stamp = epoch_;
    }
    surroundings_.setEpoch(epoch_);
    surroundings_.setObstacles(tracks, epoch_);
    setMotions();
    surroundings_.findNeighbours();
    for (std::size_t i = 0; i < uavCount(); ++i) poseProblem(i);
    const QpModels models = makeQpModels(mission_.parameters);
    tables_ = std::make_shared<GeneratedTables>(std::vector<QpModel>{models.straight, models.corner});
  }

  void setMotions() {
    for (std::size_t i = 0; i < uavCount(); ++i) {
      surroundings_.setMotions(i, flight_.planner().committed(i), nullptr);
      surroundings_.setPlanning(i, flight_.planner().committed(i).at(epoch_));
    }
  }

  std::size_t uavCount() const { return mission_.scenario.uavs.size(); }
  double band() const { return 2.0 * mission_.parameters.limits.max_speed * mission_.parameters.time.sampling_time; }
  Surroundings& surroundings() { return surroundings_; }
  PerfectFlight& flight() { return flight_; }
  std::vector<UavProblem>& problems() { return problems_; }
  const std::vector<Trajectory>& guesses() const { return guesses_; }
  double epoch() const { return epoch_; }
  std::unique_ptr<QpSolver> makeSolver() const { return std::make_unique<GeneratedSolver>(tables_); }

 private:
  void poseProblem(std::size_t uav) {
    UavProblem problem;
    problem.parameters = &mission_.parameters;
    problem.dt = mission_.parameters.time.sampling_time;
    problem.bounds = FlightBounds(mission_.parameters, nullptr);
    problem.start = flight_.planner().committed(uav).at(epoch_);
    problem.epoch = epoch_;
    const MovingTarget& reference = flight_.planner().reference(uav);
    problem.path = &reference.path;
    problem.progress = reference.path.nearest(problem.start.p, 0.0, 1e9).arc_length;
    for (std::size_t k = 0; k <= kHorizon; ++k) {
      problem.targets[k] = reference.at(epoch_ + static_cast<double>(k) * problem.dt);
    }
    surroundings_.collect(uav, problem);
    Trajectory guess;
    shiftPlan(flight_.planner().committed(uav), problem.start, epoch_, problem.dt, guess);
    problems_.push_back(problem);
    guesses_.push_back(guess);
  }

  Mission mission_;
  PerfectFlight flight_;
  Surroundings surroundings_;
  double epoch_ = 0.0;
  std::vector<UavProblem> problems_;
  std::vector<Trajectory> guesses_;
  std::shared_ptr<const GeneratedTables> tables_;
};

/// Flown once per size.
MidFlight& midFlight(const benchmark::State& state) {
  static std::map<std::int64_t, MidFlight> flights;
  return flights.try_emplace(state.range(0), static_cast<int>(state.range(0))).first->second;
}

void perUav(benchmark::State& state) {
  state.counters["per_uav"] = benchmark::Counter(
      static_cast<double>(state.range(0)), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Whole cycles of a flight: snapshot in, plans out.
void cycle(benchmark::State& state) {
  const Mission mission = makeMission(paperScaling(static_cast<int>(state.range(0))), {}, "paper");
  auto flight = std::make_unique<PerfectFlight>(mission);
  for (auto _ : state) {
    if (flight->now() > 60.0) flight = std::make_unique<PerfectFlight>(mission);
    state.SetIterationTime(flight->cycle().cycle_time);
  }
  perUav(state);
}

/// Every UAV's motion on the stages of the new horizon, and the box that it can reach.
void predictMotions(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  for (auto _ : state) swarm.setMotions();
  perUav(state);
}

/// Who can meet whom, and the order of the UAVs.
void findNeighbours(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  SolveOrder order;
  for (auto _ : state) {
    swarm.surroundings().findNeighbours();
    order.build(swarm.surroundings().neighbours(), 0);
    benchmark::DoNotOptimize(order.rounds());
  }
  perUav(state);
}

/// Bodies that each UAV has to keep clear of.
void collectBodies(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  for (auto _ : state) {
    for (std::size_t i = 0; i < swarm.uavCount(); ++i) swarm.surroundings().collect(i, swarm.problems()[i]);
  }
  perUav(state);
}

/// The QP's gradients and rows: frames on the path, robustness function, gauges, tangent planes.
void posingTheQp(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  const auto qp = std::make_unique<Qp>();
  SegmentPlanes planes;
  double rows = 0.0;
  for (auto _ : state) {
    rows = 0.0;
    for (std::size_t i = 0; i < swarm.uavCount(); ++i) {
      linearise(swarm.problems()[i], swarm.guesses()[i], swarm.band(), *qp, planes);
      rows += qp->rowCount();
    }
  }
  state.counters["rows_per_qp"] = rows / static_cast<double>(swarm.uavCount());
  perUav(state);
}

/// The QP alone from a cold start, its data copied into the solver.
void solvingTheQp(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  const std::unique_ptr<QpSolver> solver = swarm.makeSolver();
  std::vector<Qp> qps(swarm.uavCount());
  SegmentPlanes planes;
  for (std::size_t i = 0; i < qps.size(); ++i) {
    linearise(swarm.problems()[i], swarm.guesses()[i], swarm.band(), qps[i], planes);
  }
  QpSolution solution;
  double changes = 0.0;
  for (auto _ : state) {
    changes = 0.0;
    for (const Qp& qp : qps) {
      solution.active.count = 0;
      solver->solve(qp, solution);
      changes += solution.iterations;
    }
  }
  state.counters["changes_per_qp"] = changes / static_cast<double>(qps.size());
  perUav(state);
}

/// Cost and violation of one candidate, as the line search asks for them.
void evaluatingMerit(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  for (auto _ : state) {
    for (std::size_t i = 0; i < swarm.uavCount(); ++i) {
      benchmark::DoNotOptimize(merit(swarm.problems()[i], swarm.guesses()[i]).value);
    }
  }
  perUav(state);
}

/// All of a UAV's sequential quadratic programming, the first QP from a cold start.
void sqp(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  SqpSolver solver(swarm.makeSolver());
  Trajectory plan;
  ActiveRows active;
  for (auto _ : state) {
    for (std::size_t i = 0; i < swarm.uavCount(); ++i) {
      plan = swarm.guesses()[i];
      active.count = 0;
      benchmark::DoNotOptimize(solver.solve(swarm.problems()[i], plan, active));
    }
  }
  perUav(state);
}

/// Clearances of the plan for the status message.
void reportingClearance(benchmark::State& state) {
  MidFlight& swarm = midFlight(state);
  for (auto _ : state) {
    for (std::size_t i = 0; i < swarm.uavCount(); ++i) {
      benchmark::DoNotOptimize(predictedClearance(swarm.problems()[i], swarm.guesses()[i]));
    }
  }
  perUav(state);
}

BENCHMARK(cycle)->Arg(6)->Arg(16)->Arg(32)->Arg(64)->Arg(256)->Arg(1000)->UseManualTime();
BENCHMARK(predictMotions)->Arg(6)->Arg(64)->Arg(1000);
BENCHMARK(findNeighbours)->Arg(6)->Arg(64)->Arg(1000);
BENCHMARK(collectBodies)->Arg(6)->Arg(64)->Arg(1000);
BENCHMARK(posingTheQp)->Arg(6)->Arg(64)->Arg(1000);
BENCHMARK(solvingTheQp)->Arg(6)->Arg(64);
BENCHMARK(evaluatingMerit)->Arg(6)->Arg(64)->Arg(1000);
BENCHMARK(sqp)->Arg(6)->Arg(64)->Arg(1000);
BENCHMARK(reportingClearance)->Arg(6)->Arg(64)->Arg(1000);

}  // namespace
}  // namespace swarm_planner

BENCHMARK_MAIN();
