// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What the check of a plan takes, per UAV. Run it on a quiet machine:
//   .build/devel/lib/swarm_planner/benchmark_check --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <deque>
#include <map>
#include <vector>

#include "swarm/check_scene.hpp"
#include "swarm/perfect_flight.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/swarm/plan_start.hpp"

namespace swarm_planner {
namespace {

void checkScenes(benchmark::State& state, std::deque<CheckScene>& scenes) {
  double accepted = 0.0;
  for (CheckScene& scene : scenes) accepted += scene.check().accepted() ? 1.0 : 0.0;
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(scenes[next].check());
    next = next + 1 < scenes.size() ? next + 1 : 0;
  }
  state.counters["accepted"] = accepted / static_cast<double>(scenes.size());
}

/// Plans at 3 m/s with their stops; obstacles and UAVs whose own motions do not come near, though within reach.
std::deque<CheckScene>& freeScenes() {
  static std::deque<CheckScene> scenes;
  if (!scenes.empty()) return scenes;
  Random random(1);
  while (scenes.size() < 200) {
    CheckScene& scene = scenes.emplace_back();
    scene.plan(wanderingPlan(random, {Vector3::Zero(), Vector3(3.0, 0.0, 0.0), Vector3::Zero()}, 2.0, 0.0, 0.3));
    for (int i = 0; i < 5; ++i) {
      const Vector3 center(4.0 * i, i % 2 == 0 ? 6.0 : -6.0, random.uniform(-2.0, 2.0));
      scene.addObstacle(Superellipsoid(i, center, random.vector(0.5, 1.5), random.vector(2.0, 6.0), 0.3,
                                       random.integer(0, 1) * random.vector(-0.1, 0.1)));
    }
    for (int i = 0; i < 10; ++i) {
      const Vector3 p(random.uniform(-6.0, 6.0), random.uniform(5.0, 12.0) * (i % 2 == 0 ? 1.0 : -1.0),
                      random.uniform(-4.0, 4.0));
      scene.addUav(wanderingPlan(random, {p, Vector3(3.0, 0.0, 0.0), Vector3::Zero()}, 2.0, 0.0, 0.3));
    }
    if (!scene.check().accepted()) scenes.pop_back();
  }
  return scenes;
}

/// Accepted plans that pass closely, 0.1 m to 0.2 m off, by three obstacles and five UAVs, with more around up to
/// `obstacles` and `uavs`. Obstacles of any shape, most with real exponents; half of them move.
std::deque<CheckScene>& crowdedScenes(std::size_t obstacles, std::size_t uavs) {
  static std::map<std::size_t, std::deque<CheckScene>> all;
  std::deque<CheckScene>& scenes = all[obstacles];
  if (!scenes.empty()) return scenes;
  Random random(2);
  while (scenes.size() < 200) {
    CheckScene& scene = scenes.emplace_back();
    scene.planRandomly(random, 3.0);
    const auto grow = [&](std::size_t most_obstacles, std::size_t most_uavs, double near, double far) {
      while (scene.surroundings.obstacles.size() < most_obstacles) {
        scene.addRandomObstacle(random, random.uniform(0.4 + near, 0.5 + far));
        if (!scene.check().accepted()) scene.surroundings.obstacles.pop_back();
      }
      while (scene.surroundings.uavs.size() < most_uavs) {
        scene.addRandomUav(random, random.uniform(1.1 + near, 1.2 + far));
        if (scene.check().accepted()) continue;
        scene.others.pop_back();
        scene.surroundings.uavs.pop_back();
      }
    };
    if (!scene.check().accepted()) {
      scenes.pop_back();
      continue;
    }
    grow(3, 5, 0.1, 0.2);
    grow(obstacles, uavs, 0.5, 5.0);
  }
  return scenes;
}

void freeFlight(benchmark::State& state) { checkScenes(state, freeScenes()); }
void crowd(benchmark::State& state) {
  checkScenes(state, crowdedScenes(static_cast<std::size_t>(state.range(0)), static_cast<std::size_t>(state.range(1))));
}

/// The stop and the motion alone, without anything around.
void planStop(benchmark::State& state) {
  std::deque<CheckScene>& scenes = freeScenes();
  StopManoeuvre stop;
  std::size_t next = 0;
  for (auto _ : state) {
    const CheckScene& scene = scenes[next];
    planStop(scene.trajectory.knots.back(), 0.3, scene.limits.bounds, stop);
    benchmark::DoNotOptimize(stop);
    next = next + 1 < scenes.size() ? next + 1 : 0;
  }
}

void noSurroundings(benchmark::State& state) {
  std::deque<CheckScene>& scenes = freeScenes();
  const CheckSurroundings nothing;
  std::size_t next = 0;
  for (auto _ : state) {
    CheckScene& scene = scenes[next];
    benchmark::DoNotOptimize(
        checkPlan(scene.trajectory, scene.start, scene.committed, scene.limits, nothing, scene.motion));
    next = next + 1 < scenes.size() ? next + 1 : 0;
  }
}

/// Plans of a swarm in the middle of a flight, each against all obstacles and the UAVs whose motions come near.
class SwarmScene {
 public:
  explicit SwarmScene(const Mission& mission, int cycles) : mission_(mission), flight_(mission_) {
    flight_.cycles(cycles);
    limits_ = defaultCheckLimits();
    limits_.bounds = FlightBounds(mission_.parameters, nullptr);
    const std::size_t count = mission_.scenario.uavs.size();
    for (std::size_t i = 0; i < mission_.scenario.obstacles.size(); ++i) {
      bodies_.push_back(flight_.obstacle(i, flight_.now()));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const CommittedMotion& motion = motions_.emplace_back(flight_.planner().committed(i));
      shiftPlan(motion, motion.after(0.0), motion.epoch(), mission_.parameters.time.sampling_time,
                plans_.emplace_back());
    }
    for (std::size_t i = 0; i < count; ++i) surround(i);
  }

  std::size_t size() const { return motions_.size(); }
  double neighbours() const {
    double sum = 0.0;
    for (const CheckSurroundings& around : surroundings_) sum += static_cast<double>(around.uavs.size());
    return sum / static_cast<double>(size());
  }
  CheckVerdict check(std::size_t uav) {
    const Trajectory& plan = plans_[uav];
    return checkPlan(plan, plan.knots[0], plan.knots[0].p, limits_, surroundings_[uav], scratch_);
  }

 private:
  void surround(std::size_t uav) {
    CheckSurroundings& around = surroundings_.emplace_back();
    for (const Superellipsoid& body : bodies_) {
      PredictedObstacle obstacle;
      obstacle.body = &body;
      obstacle.stamp = flight_.now();
      obstacle.least_distance = mission_.parameters.limits.uav_radius;
      around.obstacles.push_back(obstacle);
    }
    for (std::size_t j = 0; j < size(); ++j) {
      if (j != uav && motions_[uav].box().near(motions_[j].box(), 2.2)) around.uavs.push_back({&motions_[j]});
    }
  }

  Mission mission_;
  PerfectFlight flight_;
  CheckLimits limits_;
  std::deque<Superellipsoid> bodies_;
  std::deque<CommittedMotion> motions_;
  std::deque<Trajectory> plans_;  ///< of the motions
  std::deque<CheckSurroundings> surroundings_;
  CommittedMotion scratch_;
};

void checkSwarm(benchmark::State& state, SwarmScene& swarm) {
  std::map<CheckReason, int> reasons;
  for (std::size_t i = 0; i < swarm.size(); ++i) ++reasons[swarm.check(i).reason];
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(swarm.check(next));
    next = next + 1 < swarm.size() ? next + 1 : 0;
  }
  for (const auto& [reason, count] : reasons) state.counters[checkReasonText(reason)] = count;
  state.counters["neighbours"] = swarm.neighbours();
}

/// The paper's scenario, 18 s into the flight.
void paperInFlight(benchmark::State& state) {
  static std::map<std::int64_t, SwarmScene> swarms;
  const int uavs = static_cast<int>(state.range(0));
  const Mission mission = makeMission(paperScaling(uavs), {}, "paper");
  checkSwarm(state, swarms.try_emplace(uavs, mission, 60).first->second);
}

/// UAVs that change places across a circle, when all meet in the middle.
void circleSwapInTheMiddle(benchmark::State& state) {
  static std::map<std::int64_t, SwarmScene> swarms;
  const int uavs = static_cast<int>(state.range(0));
  const Mission mission = makeMission(circleSwap(uavs, 60.0, 1), {}, "circle_swap");
  checkSwarm(state, swarms.try_emplace(uavs, mission, static_cast<int>(state.range(1))).first->second);
}

BENCHMARK(planStop);
BENCHMARK(noSurroundings);
BENCHMARK(freeFlight);
BENCHMARK(crowd)->Args({5, 10})->Args({13, 15});
BENCHMARK(paperInFlight)->Arg(16)->Arg(64)->Arg(256);
BENCHMARK(circleSwapInTheMiddle)->Args({12, 20})->Args({12, 28})->Args({12, 36});

}  // namespace
}  // namespace swarm_planner

BENCHMARK_MAIN();
