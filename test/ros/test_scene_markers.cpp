// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: a UAV in danger that looks like any other in rviz, or a motion drawn without its stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/ros/scene_markers.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {
namespace {

using visualization_msgs::Marker;

UavDrawing drawingOf(Concern concern) {
  UavDrawing uav;
  uav.name = "uav1";
  uav.concern = concern;
  uav.note = concern == Concern::kNone ? "" : "because";
  uav.located = true;
  uav.planned = true;
  Trajectory plan;
  plan.dt = 0.3;
  plan.jerks.fill(Vector3::Zero());
  KinematicState start;
  start.v = Vector3(2.0, 0.0, 0.0);
  rollOut(start, plan);
  StopManoeuvre stop;
  planStop(plan.knots.back(), plan.dt, FlightBounds(makeMission(paperSix(), {}, "paper_six").parameters, nullptr),
           stop);
  uav.plan.assign(plan, stop);
  return uav;
}

class SceneMarkersTest : public ::testing::Test {
 protected:
  Marker drawn(const UavDrawing& uav, const std::string& ns) {
    markers_.begin(ros::Time(10.0));
    markers_.addUav(0, uav);
    return find(ns);
  }
  Marker statusAfter(const UavDrawing& uav, const Vector3& position) {
    markers_.begin(ros::Time(10.0));
    markers_.addUav(0, uav);
    markers_.addStatus(position, "t", Concern::kAlarm);
    return find("status");
  }
  Marker drawnStatus(Concern concern) {
    markers_.begin(ros::Time(10.0));
    markers_.addStatus(Vector3::Zero(), "t", concern);
    return find("status");
  }

 private:
  Marker find(const std::string& ns) const {
    const auto& all = markers_.message().markers;
    const auto found = std::find_if(all.begin(), all.end(), [&ns](const Marker& marker) { return marker.ns == ns; });
    if (found != all.end()) return *found;
    ADD_FAILURE() << "nothing is drawn in " << ns;
    return Marker();
  }

  SceneMarkers markers_{"map", MarkerSizes()};
};

bool isRed(const Marker& marker) { return marker.color.r > 0.8F && marker.color.g < 0.1F && marker.color.b < 0.1F; }

TEST_F(SceneMarkersTest, AlarmIsRedAllOver) {
  for (const char* ns : {"label", "plan", "rest", "separation"}) {
    EXPECT_TRUE(isRed(drawn(drawingOf(Concern::kAlarm), ns))) << ns;
    EXPECT_FALSE(isRed(drawn(drawingOf(Concern::kCaution), ns))) << ns;
    EXPECT_FALSE(isRed(drawn(drawingOf(Concern::kNone), ns))) << ns;
  }
  EXPECT_TRUE(isRed(drawnStatus(Concern::kAlarm)));
  EXPECT_FALSE(isRed(drawnStatus(Concern::kCaution)));
}

TEST_F(SceneMarkersTest, CautionIsToldFromAllWellByTheLabel) {
  const Marker well = drawn(drawingOf(Concern::kNone), "label");
  const Marker caution = drawn(drawingOf(Concern::kCaution), "label");
  EXPECT_EQ(well.text, "uav1");
  EXPECT_EQ(caution.text, "uav1: because");
  EXPECT_GT(caution.color.r, well.color.r + 0.5F);
}

TEST_F(SceneMarkersTest, LongNotesAreBrokenIntoLinesThatKeepEveryWord) {
  UavDrawing uav = drawingOf(Concern::kAlarm);
  uav.note = "no plan keeps all distances (too close to an obstacle); flying the least violating one";
  const Marker label = drawn(uav, "label");
  std::istringstream lines(label.text);
  std::string joined;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 36U) << line;
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, "uav1: " + uav.note);
  uav.note = "/a_namespace/that_goes_on_and_on/without_any_blank/odometry is silent";
  EXPECT_EQ(drawn(uav, "label").text, "uav1:\n/a_namespace/that_goes_on_and_on/without_any_blank/odometry\nis silent");
}

TEST_F(SceneMarkersTest, TheStatusLineLiesOverNoLabel) {
  UavDrawing uav = drawingOf(Concern::kAlarm);
  uav.note = "no plan keeps all distances (too close to an obstacle); flying the least violating one";
  uav.position = Vector3(0.0, 0.0, 30.0);
  const Marker label = drawn(uav, "label");
  const auto lines = 1.0 + static_cast<double>(std::count(label.text.begin(), label.text.end(), '\n'));
  EXPECT_GT(lines, 2.0);
  const Marker above = statusAfter(uav, Vector3(0.0, 0.0, 31.0));
  EXPECT_GE(above.pose.position.z - 0.5 * above.scale.z, label.pose.position.z + 0.5 * lines * label.scale.z);
  // Where there is room it stays where it was put, also when the UAV has come down again.
  EXPECT_EQ(statusAfter(uav, Vector3(0.0, 0.0, 60.0)).pose.position.z, 60.0);
  uav.position.z() = 10.0;
  EXPECT_EQ(statusAfter(uav, Vector3(0.0, 0.0, 31.0)).pose.position.z, 31.0);
}

TEST_F(SceneMarkersTest, MotionIsDrawnToItsPlaceOfRest) {
  const UavDrawing uav = drawingOf(Concern::kNone);
  const Marker plan = drawn(uav, "plan");
  const Marker rest = drawn(uav, "rest");
  const double plan_end = uav.plan.after(kHorizon * uav.plan.dt()).p.x();
  EXPECT_GT(uav.plan.restingPlace().x(), plan_end + 0.1) << "a motion that has no stop shows nothing";
  EXPECT_EQ(plan.points.front().x, 0.0);
  EXPECT_NEAR(plan.points.back().x, uav.plan.restingPlace().x(), 1e-9);
  EXPECT_NEAR(rest.pose.position.x, uav.plan.restingPlace().x(), 1e-9);
}

}  // namespace
}  // namespace swarm_planner
