// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace swarm_planner {

/// Brings poses that arrive in any frame into the planning frame. Never waits: where tf lags behind the data, the
/// newest transform serves, if it is recent enough.
class FrameTransformer {
 public:
  /// `max_lag`: a transform may be so much older or newer than what it is applied to [s].
  FrameTransformer(const tf2::BufferCore& buffer, std::string planning_frame, double max_lag);

  const std::string& planningFrame() const { return planning_frame_; }

  /// The pose of `frame` in the planning frame at `stamp` (zero: the newest), or nothing and `why`.
  std::optional<Eigen::Isometry3d> toPlanning(const std::string& frame, const ros::Time& stamp, std::string& why) const;

 private:
  const tf2::BufferCore& buffer_;
  std::string planning_frame_;
  double max_lag_;
};

}  // namespace swarm_planner
