// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: an operator who is not told which UAV holds everything up, and why.
#include <gtest/gtest.h>

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
  toMessage(planner_, {kNow, "map", true, 4}, reasons, message);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp.toSec(), kNow);
  EXPECT_TRUE(message.started);
  EXPECT_DOUBLE_EQ(message.time_zero.toSec(), kNow + 0.3);
  EXPECT_TRUE(message.deadline_missed);
  EXPECT_EQ(message.deadline_misses, 4U);
  ASSERT_EQ(message.uavs.size(), inputs_.size());
  EXPECT_EQ(message.uavs[1].name, "uav2");
  EXPECT_EQ(message.uavs[1].reason, "because");
  EXPECT_EQ(message.uavs[1].state, UavStatus::TRACKING);
  EXPECT_TRUE(message.uavs[1].planned);
  EXPECT_NEAR(message.uavs[1].target.x, 20.0, 1e-9);
}

}  // namespace
}  // namespace swarm_planner
