// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: an alarm of one cycle that passes between two diagnostics and is never seen.
#include <gtest/gtest.h>

#include "swarm_planner/ros/status_tally.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {
namespace {

UavStatus uavStatus(std::uint8_t state, const std::string& reason = "", bool alarm = false) {
  UavStatus uav;
  uav.state = state;
  uav.reason = reason;
  uav.alarm = alarm;
  return uav;
}

PlannerStatus cycleOf(const UavStatus& uav) {
  PlannerStatus status;
  status.uavs = {uavStatus(UavStatus::TRACKING), uav};
  return status;
}

TEST(Concern, TellsAlarmsFromCautions) {
  EXPECT_EQ(concernOf(uavStatus(UavStatus::TRACKING)), Concern::kNone);
  EXPECT_EQ(concernOf(uavStatus(UavStatus::TRACKING, "strays")), Concern::kCaution);
  EXPECT_EQ(concernOf(uavStatus(UavStatus::HOLDING, "waits")), Concern::kCaution);
  EXPECT_EQ(concernOf(uavStatus(UavStatus::FALLBACK, "refused")), Concern::kCaution);
  EXPECT_EQ(concernOf(uavStatus(UavStatus::FALLBACK, "no way out", true)), Concern::kAlarm);
  EXPECT_EQ(concernOf(uavStatus(UavStatus::LOST, "silent")), Concern::kAlarm);
}

TEST(Concern, OfACommandThatIsCarriedOutIsNone) {
  UavStatus uav = uavStatus(UavStatus::LANDING, "descends");
  EXPECT_EQ(concernOf(uav), Concern::kCaution);
  uav.commanded = true;
  EXPECT_EQ(concernOf(uav), Concern::kNone);
  uav.alarm = true;
  EXPECT_EQ(concernOf(uav), Concern::kAlarm);
}

TEST(Concern, AShorterStepThatPassedIsNone) {
  UavStatus uav = uavStatus(UavStatus::TRACKING);
  uav.refusal = "too close to an obstacle";
  EXPECT_EQ(concernOf(uav), Concern::kNone);
}

TEST(StatusTally, KeepsTheWorstOfEachUav) {
  StatusTally tally;
  tally.add(cycleOf(uavStatus(UavStatus::TRACKING)));
  tally.add(cycleOf(uavStatus(UavStatus::FALLBACK, "no way out", true)));
  tally.add(cycleOf(uavStatus(UavStatus::FALLBACK, "refused")));
  tally.add(cycleOf(uavStatus(UavStatus::TRACKING)));
  ASSERT_EQ(tally.worst().size(), 2U);
  EXPECT_EQ(tally.worst()[0].state, UavStatus::TRACKING);
  EXPECT_TRUE(tally.worst()[1].alarm);
  EXPECT_EQ(tally.worst()[1].reason, "no way out");
}

TEST(StatusTally, OfEqualsKeepsTheNewest) {
  StatusTally tally;
  tally.add(cycleOf(uavStatus(UavStatus::FALLBACK, "older")));
  tally.add(cycleOf(uavStatus(UavStatus::FALLBACK, "newer")));
  EXPECT_EQ(tally.worst()[1].reason, "newer");
}

TEST(StatusTally, CountsCyclesAndPlans) {
  StatusTally tally;
  PlannerStatus status = cycleOf(uavStatus(UavStatus::TRACKING));
  status.cycle_time = 0.1;
  tally.add(status);
  status.cycle_time = 0.3;
  status.deadline_missed = true;
  status.out_of_time = true;
  status.refused_tracks = 4;
  status.uavs[0].refusal = "too close to another UAV";
  tally.add(status);
  status.deadline_missed = false;
  status.refused_tracks = 2;
  status.cycle_time = 0.2;
  tally.add(status);
  EXPECT_EQ(tally.cycles(), 3U);
  EXPECT_EQ(tally.deadlineMisses(), 1U);
  EXPECT_EQ(tally.outOfTime(), 2U);
  EXPECT_EQ(tally.rejectedPlans(), 2U);
  EXPECT_EQ(tally.refusedTracks(), 4U);
  EXPECT_NEAR(tally.meanCycleTime(), 0.2, 1e-12);
  EXPECT_EQ(tally.maxCycleTime(), 0.3);
}

TEST(StatusTally, ForgetsWithTheReport) {
  StatusTally tally;
  tally.add(cycleOf(uavStatus(UavStatus::LOST, "silent")));
  tally.clear();
  EXPECT_EQ(tally.cycles(), 0U);
  EXPECT_EQ(tally.meanCycleTime(), 0.0);
  EXPECT_TRUE(tally.worst().empty());
  tally.add(cycleOf(uavStatus(UavStatus::TRACKING)));
  EXPECT_EQ(tally.worst()[1].state, UavStatus::TRACKING);
}

}  // namespace
}  // namespace swarm_planner
