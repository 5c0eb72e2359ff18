// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/cloud_conversion.hpp"

#include <sensor_msgs/PointField.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace swarm_planner {
namespace {

using sensor_msgs::PointField;

std::size_t sizeOf(const PointField& field) {
  if (field.datatype == PointField::FLOAT32) return sizeof(float);
  return field.datatype == PointField::FLOAT64 ? sizeof(double) : 0;
}

/// The field of that name, if it holds a floating-point number within a point.
const PointField* findField(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&name](const PointField& candidate) { return candidate.name == name; });
  if (field == cloud.fields.end() || sizeOf(*field) == 0) return nullptr;
  return std::uint64_t{field->offset} + sizeOf(*field) <= cloud.point_step ? &*field : nullptr;
}

double read(const std::uint8_t* point, const PointField& field) {
  if (field.datatype == PointField::FLOAT64) {
    double value = 0.0;
    std::memcpy(&value, point + field.offset, sizeof(value));
    return value;
  }
  float value = 0.0F;
  std::memcpy(&value, point + field.offset, sizeof(value));
  return static_cast<double>(value);
}

/// In 64 bits: products of what a message states may overflow 32.
bool sizesFit(const sensor_msgs::PointCloud2& cloud) {
  const std::uint64_t width = cloud.width, height = cloud.height;
  if (width == 0 || height == 0) return true;
  if (cloud.point_step == 0 || width * cloud.point_step > cloud.row_step) return false;
  return (height - 1) * cloud.row_step + width * cloud.point_step <= cloud.data.size();
}

}  // namespace

std::optional<std::vector<Vector3>> pointsOf(const sensor_msgs::PointCloud2& cloud, InputFault& fault,
                                             std::string& why) {
  fault = InputFault::kMalformed;
  const PointField* fields[3] = {findField(cloud, "x"), findField(cloud, "y"), findField(cloud, "z")};
  if (fields[0] == nullptr || fields[1] == nullptr || fields[2] == nullptr) {
    why = "a cloud without fields x, y and z of type FLOAT32 or FLOAT64";
    return std::nullopt;
  }
  if (cloud.is_bigendian != 0) {
    why = "a cloud in the byte order of another machine";
    return std::nullopt;
  }
  if (!sizesFit(cloud)) {
    why = "a cloud of " + std::to_string(cloud.data.size()) + " bytes, which its sizes do not fit";
    return std::nullopt;
  }
  fault = InputFault::kNone;
  std::vector<Vector3> points;
  points.reserve(std::size_t{cloud.width} * cloud.height);
  for (std::size_t row = 0; cloud.width > 0 && row < cloud.height; ++row) {
    const std::uint8_t* point = cloud.data.data() + row * cloud.row_step;
    for (std::size_t i = 0; i < cloud.width; ++i, point += cloud.point_step) {
      points.emplace_back(read(point, *fields[0]), read(point, *fields[1]), read(point, *fields[2]));
    }
  }
  return points;
}

}  // namespace swarm_planner
