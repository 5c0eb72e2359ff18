// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: setpoints stamped a little off, or a node that dies of a time that ROS cannot hold.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "swarm_planner/ros/time_conversion.hpp"

namespace swarm_planner {
namespace {

TEST(TimeConversion, SurvivesARoundTripToAMicrosecond) {
  for (const ros::Time time :
       {ros::Time(0, 1), ros::Time(1, 0), ros::Time(1767225600, 123456789), ros::Time(4102444800U, 999999999)}) {
    const ros::Duration error = toRosTime(toSeconds(time)) - time;
    EXPECT_LT(std::abs(error.toSec()), 1e-6) << time;
  }
}

TEST(TimeConversion, CarriesAFractionThatRoundsUpToASecond) { EXPECT_EQ(toRosTime(4.9999999999), ros::Time(5, 0)); }

TEST(TimeConversion, ClampsWhatRosTimeCannotHold) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double seconds : {-1.0, -kInfinity, std::numeric_limits<double>::quiet_NaN(), 0.0}) {
    EXPECT_TRUE(toRosTime(seconds).isZero()) << seconds;
  }
  for (const double seconds : {1e12, kInfinity}) EXPECT_EQ(toRosTime(seconds), ros::TIME_MAX) << seconds;
}

}  // namespace
}  // namespace swarm_planner
