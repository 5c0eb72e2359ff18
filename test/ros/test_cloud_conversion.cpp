// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, a driver's cloud makes walls where there are none, or a bad one ends the planner.
#include <gtest/gtest.h>
#include <sensor_msgs/PointField.h>

#include <cstring>
#include <limits>
#include <random>

#include "swarm_planner/ros/cloud_conversion.hpp"

namespace swarm_planner {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr std::uint32_t kStep = 20;

/// Fields intensity, x, y, z, as floats, and four bytes that nobody uses; `height` rows with eight more bytes each.
PointCloud2 cloudOf(const std::vector<Vector3>& points, std::uint32_t height) {
  PointCloud2 cloud;
  cloud.height = height;
  cloud.width = static_cast<std::uint32_t>(points.size()) / height;
  cloud.point_step = kStep;
  cloud.row_step = cloud.width * kStep + 8;
  std::uint32_t offset = 0;
  for (const char* name : {"intensity", "x", "y", "z"}) {
    PointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    offset += sizeof(float);
  }
  cloud.data.resize(std::size_t{cloud.row_step} * height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = points[i].cast<float>();
    std::memcpy(&cloud.data[i / cloud.width * cloud.row_step + i % cloud.width * kStep + 4], p.data(), 12);
  }
  return cloud;
}

std::string whyNot(const PointCloud2& cloud) {
  InputFault fault = InputFault::kNone;
  std::string why;
  EXPECT_FALSE(pointsOf(cloud, fault, why));
  EXPECT_EQ(fault, InputFault::kMalformed);
  return why;
}

TEST(CloudConversion, PointsAreReadRowByRow) {
  const std::vector<Vector3> points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {-1, -2, 0.5}};
  for (const std::uint32_t height : {1U, 2U}) {
    InputFault fault = InputFault::kNone;
    std::string why;
    const auto read = pointsOf(cloudOf(points, height), fault, why);
    ASSERT_TRUE(read) << why;
    EXPECT_EQ(*read, points);
  }
}

TEST(CloudConversion, CloudsThatCannotBeReadAreRefused) {
  const PointCloud2 sound = cloudOf({{1, 2, 3}, {4, 5, 6}}, 1);
  PointCloud2 bad = sound;
  bad.fields[1].name = "r";
  EXPECT_NE(whyNot(bad).find("without fields x, y and z"), std::string::npos);
  bad = sound;
  bad.fields[2].datatype = PointField::INT32;
  EXPECT_NE(whyNot(bad).find("without fields x, y and z"), std::string::npos);
  bad = sound;
  bad.fields[3].offset = std::numeric_limits<std::uint32_t>::max();
  EXPECT_NE(whyNot(bad).find("without fields x, y and z"), std::string::npos);
  bad = sound;
  bad.is_bigendian = 1;
  EXPECT_NE(whyNot(bad).find("byte order"), std::string::npos);
  bad = sound;
  bad.data.resize(30);
  EXPECT_NE(whyNot(bad).find("sizes do not fit"), std::string::npos);
  bad = sound;
  bad.width = bad.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_NE(whyNot(bad).find("sizes do not fit"), std::string::npos);
  bad = sound;
  bad.point_step = 0;
  whyNot(bad);
}

TEST(CloudConversion, NoNumbersInAMessageEndTheProgram) {
  std::mt19937 random(2);
  const auto wild = [&random] { return random() % 3 == 0 ? static_cast<std::uint32_t>(random()) : random() % 60; };
  for (int i = 0; i < 20000; ++i) {
    PointCloud2 cloud = cloudOf({{1, 2, 3}, {4, 5, 6}}, 1);
    cloud.width = static_cast<std::uint32_t>(wild());
    cloud.height = static_cast<std::uint32_t>(wild());
    cloud.point_step = static_cast<std::uint32_t>(wild());
    cloud.row_step = static_cast<std::uint32_t>(wild());
    cloud.fields[1 + random() % 3].offset = static_cast<std::uint32_t>(wild());
    cloud.data.resize(random() % 5000);
    InputFault fault = InputFault::kNone;
    std::string why;
    const auto points = pointsOf(cloud, fault, why);
    EXPECT_LE(points ? points->size() * sizeof(float) : 0, cloud.data.size());
  }
}

}  // namespace
}  // namespace swarm_planner
