// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// An aircraft that another system flies crosses everybody's path. Nobody may meet it; and that must be due to avoiding
// it, not to luck.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "swarm_planner/experiments/closed_loop_run.hpp"

namespace swarm_planner {
namespace {

constexpr const char* kScenario = "test/rostest/scenarios/external_crossing.yaml";

ParameterMap disturbed() {
  return {{"position_noise", 0.05}, {"velocity_noise", 0.05}, {"latency", 0.1}, {"jitter", 0.05}, {"drop", 0.1}};
}

/// A planner that knows nothing of the scenario's last UAV.
class Unaware : public CyclePlanner {
 public:
  explicit Unaware(Mission mission) : planner_(without(std::move(mission))) {}

  const CycleReport& plan(const Snapshot& snapshot, double epoch) override {
    Snapshot seen = snapshot;
    seen.uavs.pop_back();
    report_ = planner_.plan(seen, epoch);
    report_.uavs.emplace_back();
    return report_;
  }
  const CommittedMotion& committed(std::size_t uav) const override { return planner_.committed(uav); }

 private:
  static Mission without(Mission mission) {
    mission.scenario.uavs.pop_back();
    return mission;
  }

  SwarmPlanner planner_;
  CycleReport report_;
};

TEST(ExternalUav, IsMetByNobodyIn50DisturbedFlights) {
  const Mission mission = loadMission(kScenario, disturbed());
  double least = 1e9;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    IterativePlanner planner(mission);
    const RunResult run = ClosedLoopRun(mission, planner, seed).fly();
    ASSERT_TRUE(run.flown.collisions.empty()) << "seed " << seed << " at " << run.flown.collisions.front().time;
    EXPECT_LT(run.flown.final_lag.max, 5.0) << seed;
    least = std::min(least, run.flown.min_uav_distance.value());
  }
  EXPECT_LT(least, 8.0) << "nobody came near it: nothing was at stake";
}

TEST(ExternalUav, IsFlownIntoByThoseWhoDoNotKnowOfIt) {
  const Mission mission = loadMission(kScenario, disturbed());
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Unaware planner(mission);
    EXPECT_GE(ClosedLoopRun(mission, planner, seed).fly().flown.collisions.size(), 3U) << seed;
  }
}

// It flies behind its target, whatever the planner does.
TEST(ExternalUav, FliesItsReferenceInSimulation) {
  const Mission mission = loadMission(kScenario, {});
  IterativePlanner planner(mission);
  class Watch : public RunObserver {
   public:
    void onSample(double t, const std::vector<QuadSimulator>& vehicles, const std::vector<Superellipsoid>&) override {
      if (t > 5.0) farthest = std::max(farthest, (vehicles[4].state().p - Vector3(30, -30 + 3 * t, 10)).norm());
    }
    void onCycle(double, const CycleReport& report) override { planned = planned || report.uavs[4].planned; }
    double farthest = 0.0;
    bool planned = false;
  } watch;
  ClosedLoopRun(mission, planner, 0).fly({&watch});
  EXPECT_LT(watch.farthest, 0.05);
  EXPECT_FALSE(watch.planned);
}

}  // namespace
}  // namespace swarm_planner
