// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Faults in closed loop: that they reach the planner and the vehicles as the file says, and that a flight without them
// is not changed by there being such a thing.
#include <gtest/gtest.h>

#include <algorithm>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/experiments/experiment_flight.hpp"
#include "swarm_planner/experiments/fault_watch.hpp"

namespace swarm_planner {
namespace {

/// Lets every UAV rest where it starts, and keeps what it was asked.
class RestingPlanner : public CyclePlanner {
 public:
  explicit RestingPlanner(const Mission& mission) : motions_(mission.scenario.uavs.size()) {
    report_.uavs.resize(motions_.size());
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      motions_[i].assignRest(0.0, mission.scenario.uavs[i].start);
      report_.uavs[i].planned = true;
    }
  }

  const CycleReport& plan(const Snapshot& snapshot, double) override {
    snapshots.push_back(snapshot);
    return report_;
  }
  const CommittedMotion& committed(std::size_t uav) const override { return motions_[uav]; }
  void restart(bool record) override {
    restarts.push_back(snapshots.size());
    records.push_back(record);
  }

  std::vector<Snapshot> snapshots;
  std::vector<std::size_t> restarts;  ///< how many plans had been made before each
  std::vector<bool> records;          ///< whether there was one for each

 private:
  CycleReport report_;
  std::vector<CommittedMotion> motions_;
};

class Positions : public RunObserver {
 public:
  void onSample(double, const std::vector<QuadSimulator>& vehicles, const std::vector<Superellipsoid>&) override {
    for (const QuadSimulator& vehicle : vehicles) flown.push_back(vehicle.state().p);
  }
  void onCycle(double epoch, const CycleReport&) override { epochs.push_back(epoch); }

  std::vector<Vector3> flown;
  std::vector<double> epochs;
};

Mission twoHovering(const std::vector<FaultInjection>& faults) {
  Mission mission;
  mission.scenario.name = "hovering";
  mission.scenario.end.duration = 6.0;
  for (int i = 0; i < 2; ++i) {
    ScenarioUav uav;
    uav.name = "uav" + std::to_string(i + 1);
    uav.start = Vector3(0.0, 10.0 * i, 5.0);
    uav.reference = {uav.start};
    mission.scenario.uavs.push_back(uav);
    mission.scenario.obstacles.emplace_back();
    mission.scenario.obstacles.back().id = i;
    mission.scenario.obstacles.back().center = Vector3(50.0, 10.0 * i, 5.0);
  }
  mission.scenario.faults = faults;
  return mission;
}

/// A swap with every disturbance, under way for 4 s.
std::vector<Vector3> flownSwap(const std::vector<FaultInjection>& faults) {
  Scenario scenario = circleSwap(4, 6.0, 1);
  scenario.end = EndCondition();
  scenario.end.duration = 4.0;
  scenario.faults = faults;
  const ParameterMap given = {{"latency", 0.1}, {"jitter", 0.05},         {"drop", 0.1},
                              {"wind", 0.3},    {"position_noise", 0.02}, {"velocity_noise", 0.02}};
  const Mission mission = makeMission(scenario, given, "swap");
  IterativePlanner planner(mission);
  Positions positions;
  ClosedLoopRun(mission, planner, 5).fly({&positions});
  return positions.flown;
}

TEST(FaultFlights, AFaultThatNeverComesChangesNothing) {
  const std::vector<Vector3> without = flownSwap({});
  std::vector<FaultInjection> later;
  for (const FaultKindInfo& info : faultKinds()) {
    later.push_back({info.kind, info.of_uav ? "uav1" : "", 100.0, info.lasts ? 1.0 : 0.0, info.default_magnitude});
  }
  EXPECT_EQ(without, flownSwap(later));
  EXPECT_NE(without, flownSwap({{FaultKind::kWind, "uav1", 1.0, 1.0, 3.0}})) << "the comparison notices nothing";
}

TEST(FaultFlights, ADeadPlannerPlansNothingAndIsFollowedByANewOne) {
  const Mission mission = twoHovering({{FaultKind::kPlannerDead, "", 2.0, 1.5, 0.0}});
  RestingPlanner planner(mission);
  Positions positions;
  ClosedLoopRun(mission, planner, 0).fly({&positions});
  double longest = 0.0;
  for (std::size_t i = 1; i < planner.snapshots.size(); ++i) {
    longest = std::max(longest, planner.snapshots[i].now - planner.snapshots[i - 1].now);
    EXPECT_FALSE(planner.snapshots[i].now >= 2.0 && planner.snapshots[i].now < 3.5);
  }
  EXPECT_NEAR(longest, 1.8, 1e-9);
  ASSERT_EQ(planner.restarts.size(), 1u);
  EXPECT_NEAR(planner.snapshots[planner.restarts[0]].now, 3.6, 1e-9);
  EXPECT_EQ(positions.epochs.size(), planner.snapshots.size()) << "cycles are told that nobody planned";
}

TEST(FaultFlights, SomePlannersThatDieLeaveARecord) {
  std::vector<FaultInjection> faults;
  for (double at = 1.0; at < 40.0; at += 2.0) faults.push_back({FaultKind::kPlannerDead, "", at, 1.0, 0.0});
  Mission mission = twoHovering(faults);
  mission.scenario.end.duration = 45.0;
  RestingPlanner planner(mission);
  ClosedLoopRun(mission, planner, 0).fly();
  const auto left = std::count(planner.records.begin(), planner.records.end(), true);
  EXPECT_EQ(planner.records.size(), faults.size());
  EXPECT_GT(left, 4);
  EXPECT_LT(left, 16);
}

TEST(FaultFlights, WithoutFaultsThePlannerLivesOn) {
  const Mission mission = twoHovering({});
  RestingPlanner planner(mission);
  ClosedLoopRun(mission, planner, 0).fly();
  EXPECT_TRUE(planner.restarts.empty());
  for (std::size_t i = 1; i < planner.snapshots.size(); ++i) {
    EXPECT_NEAR(planner.snapshots[i].now - planner.snapshots[i - 1].now, 0.3, 1e-9);
  }
}

TEST(FaultFlights, LostOdometryAndTracksGrowOldInTheSnapshot) {
  const Mission mission =
      twoHovering({{FaultKind::kOdometryLost, "uav2", 2.0, 2.0, 0.0}, {FaultKind::kTracksLost, "", 2.0, 2.0, 0.0}});
  RestingPlanner planner(mission);
  ClosedLoopRun(mission, planner, 0).fly();
  for (const Snapshot& snapshot : planner.snapshots) {
    const double now = snapshot.now;
    const bool lost = now >= 2.0 && now < 4.0;
    EXPECT_NEAR(snapshot.uavs[0].stamp, now, 1e-9);
    EXPECT_NEAR(snapshot.uavs[1].stamp, lost ? 2.0 : now, lost ? 0.021 : 1e-9);
    ASSERT_EQ(snapshot.obstacles.size(), 2u);
    EXPECT_NEAR(snapshot.obstacles[1].stamp, lost ? 2.0 : now, lost ? 0.11 : 1e-9);
  }
}

TEST(FaultFlights, AFlickeringTrackIsKeptFromTheLastMessageThatHadIt) {
  const Mission mission = twoHovering({{FaultKind::kTracksFlicker, "", 1.0, 4.0, 0.6}});
  RestingPlanner planner(mission);
  ClosedLoopRun(mission, planner, 0).fly();
  int older = 0;
  for (const Snapshot& snapshot : planner.snapshots) {
    ASSERT_EQ(snapshot.obstacles.size(), 2u);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(snapshot.obstacles[static_cast<std::size_t>(i)].shape.id(), i);
    const bool is_older = std::any_of(snapshot.obstacles.begin(), snapshot.obstacles.end(),
                                      [&](const TrackedObstacle& track) { return track.stamp < snapshot.now - 0.05; });
    if (is_older) ++older;
    EXPECT_FALSE(is_older && (snapshot.now < 1.0 || snapshot.now > 5.0)) << snapshot.now;
  }
  EXPECT_GT(older, 3);
}

TEST(FaultFlights, WindBlowsItsVehicleAwayAndLetsItComeBack) {
  Mission mission = twoHovering({{FaultKind::kWind, "uav2", 1.0, 2.0, 5.0}});
  RestingPlanner planner(mission);
  Positions positions;
  ClosedLoopRun(mission, planner, 0).fly({&positions});
  double off[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < positions.flown.size(); ++i) {
    off[i % 2] = std::max(off[i % 2], (positions.flown[i] - mission.scenario.uavs[i % 2].start).norm());
  }
  EXPECT_LT(off[0], 1e-6);
  EXPECT_GT(off[1], 0.5);
  EXPECT_LT((positions.flown.back() - mission.scenario.uavs[1].start).norm(), 0.05);
}

TEST(FaultFlights, TheShippedRehearsalKeepsClearAndTellsEachFault) {
  const Mission mission = loadMission("config/scenarios/rehearsal.yaml", {});
  const RunResult run = flyExperimentRun({mission, 0, false, PlanningMode::kIterative, {}});
  EXPECT_TRUE(run.flown.collisions.empty());
  EXPECT_EQ(run.faults.kinds.size(), faultKinds().size() - 1) << "all but planner_dead";
  for (const FaultTally& tally : run.faults.kinds) {
    EXPECT_EQ(tally.recovered, tally.injected) << faultKindInfo(tally.kind).name;
  }
  EXPECT_LT(run.faults.recovery_time, FaultWatch::kRecoveryTime);
  for (const FaultKind kind :
       {FaultKind::kOdometryLost, FaultKind::kOdometryStale, FaultKind::kOdometryNotFinite, FaultKind::kOdometryJump}) {
    const auto tally = std::find_if(run.faults.kinds.begin(), run.faults.kinds.end(),
                                    [kind](const FaultTally& x) { return x.kind == kind; });
    ASSERT_NE(tally, run.faults.kinds.end());
    EXPECT_EQ(tally->noticeable, tally->injected) << faultKindInfo(kind).name;
    EXPECT_EQ(tally->reported, tally->noticeable) << faultKindInfo(kind).name;
  }
}

}  // namespace
}  // namespace swarm_planner
