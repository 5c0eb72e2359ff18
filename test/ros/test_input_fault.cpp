// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a console full of somebody's ten megabytes, or of control characters; a cause that is not told.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "swarm_planner/ros/input_fault.hpp"
#include "swarm_planner/ros/transform_input.hpp"

namespace swarm_planner {
namespace {

TEST(InputFault, TextOfOthersIsShownOnlySoFar) {
  EXPECT_EQ(shortened("odom"), "odom");
  EXPECT_EQ(shortened(std::string(10000000, 'x'), 5), "xxxxx... (10000000 characters)");
  EXPECT_EQ(shortened(std::string(80, 'y')), std::string(80, 'y'));
  EXPECT_EQ(shortened(std::string("a\n\x1b[31m\xff\0b", 10)), "a??[31m??b");
}

TEST(InputFault, EveryCauseHasWordsOfItsOwn) {
  std::set<std::string> words;
  for (std::size_t i = 0; i < kInputFaults; ++i) words.insert(faultText(static_cast<InputFault>(i)));
  EXPECT_EQ(words.size(), kInputFaults);
  EXPECT_EQ(words.count(""), 0U);
}

TEST(InputFault, CountsAddUpByCause) {
  FaultCounts counts;
  counts.add(InputFault::kAbsurd);
  FaultCounts more;
  more.add(InputFault::kAbsurd, 2);
  more.add(InputFault::kMalformed);
  counts.add(more);
  EXPECT_EQ(counts.of(InputFault::kAbsurd), 3U);
  EXPECT_EQ(counts.of(InputFault::kNotFinite), 0U);
  EXPECT_EQ(counts.total(), 4U);
}

TEST(TransformInput, JudgesNamesAndNumbers) {
  geometry_msgs::TransformStamped good;
  good.header.frame_id = "map";
  good.child_frame_id = "odom";
  good.transform.rotation.w = 1.0;
  EXPECT_EQ(faultOf(good), InputFault::kNone);
  const auto judge = [&good](auto&& change) {
    geometry_msgs::TransformStamped transform = good;
    change(transform);
    return faultOf(transform);
  };
  EXPECT_EQ(judge([](auto& t) { t.transform.translation.z = std::nan(""); }), InputFault::kNotFinite);
  EXPECT_EQ(judge([](auto& t) { t.transform.rotation.x = HUGE_VAL; }), InputFault::kNotFinite);
  EXPECT_EQ(judge([](auto& t) { t.transform.translation.x = 1e8; }), InputFault::kAbsurd);
  EXPECT_EQ(judge([](auto& t) { t.transform.rotation.w = 0.0; }), InputFault::kOrientation);
  EXPECT_EQ(judge([](auto& t) { t.transform.rotation.w = 1.2; }), InputFault::kOrientation);
  EXPECT_EQ(judge([](auto& t) { t.child_frame_id = "map"; }), InputFault::kFrame);
  EXPECT_EQ(judge([](auto& t) { t.child_frame_id = ""; }), InputFault::kFrame);
  EXPECT_EQ(judge([](auto& t) { t.header.frame_id = std::string(kLongestName + 1, 'm'); }), InputFault::kFrame);
}

}  // namespace
}  // namespace swarm_planner
