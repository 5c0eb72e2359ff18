// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <cstdint>
#include <string>
#include <vector>

#include "swarm_planner/PlannerStatus.h"
#include "swarm_planner/ros/input_store.hpp"
#include "swarm_planner/ros/map_input.hpp"
#include "swarm_planner/ros/status_tally.hpp"
#include "swarm_planner/ros/transform_input.hpp"

namespace swarm_planner {

/// The planner's health on /diagnostics: the cycle, the obstacle tracks, the transforms, the map, and one entry per
/// UAV.
class PlannerDiagnostics {
 public:
  /// `track_timeout` [s]: tracks older than that are out of use.
  PlannerDiagnostics(const std::vector<std::string>& uav_names, double cycle_period, double track_timeout);

  /// Notes a cycle.
  void addCycle(const PlannerStatus& status);
  /// Notes a request for a new reference.
  void addReference(bool accepted) { ++(accepted ? references_ : references_refused_); }
  /// Publishes the state since the last call; `now` [s] is ROS time, `clock` what is amiss with it.
  void publish(const std::vector<UavInput>& uavs, const TrackInput& tracks, const TransformInputReport& transforms,
               const MapInputReport& map, double now, const std::string& clock);
  /// Time has jumped back: rates start anew.
  void restart();

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  void describeCycle(Status& status);
  void describeTracks(Status& status);
  void describeTransforms(Status& status);
  void describeMap(Status& status);
  void describeUav(std::size_t uav, Status& status);
  double rate(std::uint64_t count, std::uint64_t last_count) const;

  const double cycle_period_;
  const double track_timeout_;
  diagnostic_updater::Updater updater_;
  PlannerStatus planner_status_;
  std::vector<UavInput> uavs_, last_uavs_;
  TrackInput tracks_, last_tracks_;
  TransformInputReport transforms_, last_transforms_;
  MapInputReport map_, last_map_;
  std::uint64_t references_ = 0, references_refused_ = 0;
  double now_ = 0.0, last_time_ = 0.0;  ///< [s]
  std::string clock_;                   ///< what is amiss with ROS time
  StatusTally tally_;                   ///< since the last publication
};

}  // namespace swarm_planner
