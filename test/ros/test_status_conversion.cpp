// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: an operator who is not told which UAV holds everything up, and why.
#include <gtest/gtest.h>

#include <cmath>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/ros/status_conversion.hpp"

namespace swarm_planner {
namespace {

class StatusConversion : public ::testing::Test {
 protected:
  StatusConversion() { snapshot_.uavs.resize(mission_.scenario.uavs.size()); }

  void measure(std::size_t uav) {
    snapshot_.uavs[uav].received = true;
    snapshot_.uavs[uav].stamp = kNow;
    snapshot_.uavs[uav].p = mission_.scenario.uavs[uav].start;
    inputs_[uav].received = true;
  }
  std::string reason(std::size_t uav) {
    snapshot_.now = kNow;
    planner_.plan(snapshot_, kNow + 0.3);
    return describeReason(planner_, uav, inputs_, "/" + planner_.uavName(uav) + "/odometry");
  }

  PlannerStatus statusMessage() const {
    PlannerStatus message;
    toMessage(planner_, {kNow, "map", false, 0, 0}, std::vector<std::string>(inputs_.size()), message);
    return message;
  }
  static TrackedObstacle obstacleAt(const Vector3& center, const Vector3& velocity) {
    TrackedObstacle obstacle;
    obstacle.shape = Superellipsoid(1, center, Vector3::Constant(40.0), Vector3::Constant(2.0), 0.0, velocity);
    obstacle.stamp = kNow;
    return obstacle;
  }

  static constexpr double kNow = 20.0;
  Mission mission_ = makeMission(paperSix(), {}, "paper_six");
  SwarmPlanner planner_{mission_};
  Snapshot snapshot_;
  std::vector<UavInput> inputs_{mission_.scenario.uavs.size()};
};

TEST_F(StatusConversion, NamesTheSilentTopic) {
  EXPECT_EQ(reason(2), "waiting for odometry: nothing received on /uav3/odometry");
}

TEST_F(StatusConversion, TellsWhatIsWrongWithTheMessagesThatCome) {
  inputs_[2].fault = "odometry position is not finite";
  EXPECT_EQ(reason(2), "odometry position is not finite");
}

TEST_F(StatusConversion, NamesTheUavsThatOthersWaitFor) {
  for (const std::size_t uav : {0U, 1U, 3U, 5U}) measure(uav);
  EXPECT_EQ(reason(0), "waiting for odometry of uav3, uav5");
}

TEST_F(StatusConversion, MessageCarriesTheReport) {
  for (std::size_t uav = 0; uav < inputs_.size(); ++uav) measure(uav);
  ASSERT_EQ(reason(0), "");
  PlannerStatus message;
  std::vector<std::string> reasons(inputs_.size());
  reasons[1] = "because";
  toMessage(planner_, {kNow, "map", true, 4, 7}, reasons, message);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp.toSec(), kNow);
  EXPECT_TRUE(message.started);
  EXPECT_DOUBLE_EQ(message.time_zero.toSec(), kNow + 0.3);
  EXPECT_TRUE(message.deadline_missed);
  EXPECT_EQ(message.deadline_misses, 4U);
  EXPECT_EQ(message.rejected_plans, 7U);
  EXPECT_FALSE(message.out_of_time);
  EXPECT_EQ(message.refused_tracks, 0U);
  ASSERT_EQ(message.uavs.size(), inputs_.size());
  EXPECT_EQ(message.uavs[1].name, "uav2");
  EXPECT_EQ(message.uavs[1].reason, "because");
  EXPECT_EQ(message.uavs[1].state, UavStatus::TRACKING);
  EXPECT_TRUE(message.uavs[1].planned);
  EXPECT_NEAR(message.uavs[1].target.x, 20.0, 1e-9);
  EXPECT_EQ(message.uavs[1].refusal, "");
  EXPECT_FALSE(message.uavs[1].alarm);
}

TEST_F(StatusConversion, MessageTellsWhoHadNoTime) {
  for (std::size_t uav = 0; uav < inputs_.size(); ++uav) measure(uav);
  ASSERT_EQ(reason(0), "");
  snapshot_.now += 0.3;
  for (UavMeasurement& uav : snapshot_.uavs) uav.stamp = snapshot_.now;
  planner_.plan(snapshot_, snapshot_.now + 0.3, 0.0);
  EXPECT_EQ(describeReason(planner_, 1, inputs_, ""), reasonText(Reason::kOverrun));
  const PlannerStatus message = statusMessage();
  EXPECT_TRUE(message.out_of_time);
  EXPECT_EQ(message.uavs[0].state, UavStatus::TRACKING) << "whatever the time, one is planned for";
  EXPECT_EQ(message.uavs[1].state, UavStatus::FALLBACK);
  EXPECT_TRUE(message.uavs[1].planned);
}

TEST_F(StatusConversion, MessageCountsTracksThatCannotBeUsed) {
  TrackedObstacle obstacle = obstacleAt(Vector3::Zero(), Vector3::Zero());
  obstacle.stamp = kNow + 10.0;
  snapshot_.obstacles = {obstacle};
  reason(0);
  EXPECT_EQ(statusMessage().refused_tracks, 1U);
}

TEST_F(StatusConversion, AlarmsWhereThereIsNoWayOut) {
  for (std::size_t uav = 0; uav < inputs_.size(); ++uav) measure(uav);
  ASSERT_EQ(reason(2), "");
  // Comes faster than the UAV can fly, and is there when the plan begins.
  const Vector3 before = mission_.scenario.uavs[2].start + Vector3(45.0, 0.0, 0.0);
  snapshot_.obstacles = {obstacleAt(before, Vector3(-40.0, 0.0, 0.0))};
  const std::string text = reason(2);
  const PlannerStatus message = statusMessage();
  EXPECT_TRUE(message.uavs[2].alarm);
  EXPECT_EQ(message.uavs[2].state, UavStatus::FALLBACK);
  ASSERT_NE(message.uavs[2].refusal, "");
  EXPECT_EQ(text, "no plan keeps all distances (" + message.uavs[2].refusal + "); flying the least violating one");
}

TEST_F(StatusConversion, MessageCarriesTheDeviation) {
  for (std::size_t uav = 0; uav < inputs_.size(); ++uav) measure(uav);
  ASSERT_EQ(reason(1), "");
  // Measured again beside the place where it is to rest until the epoch.
  snapshot_.uavs[1].p.y() += 0.05;
  ASSERT_EQ(reason(1), "");
  const double deviation = statusMessage().uavs[1].deviation;
  EXPECT_GT(deviation, 0.0);
  EXPECT_LE(deviation, 0.05 + 1e-9);
  EXPECT_NEAR(statusMessage().uavs[0].deviation, 0.0, 1e-9);
}

TEST(ExplainReason, SaysWhyThePlanWasRefused) {
  EXPECT_EQ(explainReason(Reason::kPlanRefused, CheckReason::kUav),
            "the plan did not pass the check (too close to another UAV); the last one goes on");
  EXPECT_EQ(explainReason(Reason::kBraking, CheckReason::kThrust),
            "no plan passed the check (exceeds the thrust limits); braking");
}

TEST(ExplainReason, LeavesOtherReasonsAsTheyAre) {
  EXPECT_EQ(explainReason(Reason::kNone, CheckReason::kUav), "") << "a shorter step flies";
  EXPECT_EQ(explainReason(Reason::kOverrun, CheckReason::kAccepted), reasonText(Reason::kOverrun));
  EXPECT_EQ(explainReason(Reason::kPlanRefused, CheckReason::kAccepted), reasonText(Reason::kPlanRefused));
  EXPECT_EQ(explainReason(Reason::kStraying, CheckReason::kUav), reasonText(Reason::kStraying))
      << "it would be told of a plan that does not fly";
}

TEST_F(StatusConversion, TellsWhatACommandMakesAUavDo) {
  for (std::size_t uav = 0; uav < 6; ++uav) measure(uav);
  reason(0);
  EXPECT_FALSE(statusMessage().uavs[0].commanded);
  planner_.command(0, FlightCommand::kHold);
  planner_.command(1, FlightCommand::kStop);
  planner_.command(2, FlightCommand::kLand);
  planner_.command(3, FlightCommand::kLeave);
  EXPECT_EQ(reason(0), "holds by command");
  EXPECT_EQ(reason(1), "stopped by command");
  EXPECT_EQ(reason(2).find("lands by command"), 0U);
  EXPECT_EQ(reason(3), "flown by another system");
  EXPECT_EQ(reason(4), "");
  const PlannerStatus message = statusMessage();
  EXPECT_EQ(message.uavs[0].state, UavStatus::HOLDING);
  EXPECT_EQ(message.uavs[1].state, UavStatus::STOPPED);
  EXPECT_EQ(message.uavs[2].state, UavStatus::LANDING);
  EXPECT_EQ(message.uavs[3].state, UavStatus::HOLDING);
  EXPECT_EQ(message.uavs[4].state, UavStatus::TRACKING);
  for (std::size_t uav = 0; uav < 6; ++uav) EXPECT_EQ(message.uavs[uav].commanded, uav < 4) << uav;
}

}  // namespace
}  // namespace swarm_planner
