// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "swarm_planner/guide/guide_planner.hpp"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/swarm/foreign_body.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {

/// Between planning cycles and the search for guides, which runs beside them: a cycle leaves what it knows here,
/// another thread searches, and a later cycle takes the answers. Neither waits for the other; while a search is not
/// done cycles leave nothing new. Nothing here takes heap after it is made.
class GuideDesk {
 public:
  GuideDesk(const Parameters& parameters, const std::optional<Workspace>& workspace, std::size_t uavs,
            std::size_t max_obstacles);

  /// In a cycle, before UAVs plan: answers that have come are taken.
  void takeAnswers(std::vector<UavRecord>& uavs);
  /// In a cycle, after UAVs have planned for `epoch` [s]: asks for guides, unless a search is under way. The motions at
  /// rest of others count as something to go round once they have lasted for a while.
  void ask(double epoch, const std::vector<TrackedObstacle>& tracks, const std::vector<ForeignBody>& foreign,
           const std::shared_ptr<const VoxelMap>& map, std::vector<UavRecord>& uavs);
  /// Searches what was asked for last, on any thread, one at a time. False if nothing was.
  bool search();

 private:
  enum class Turn { kCycle, kAsked, kSearch, kAnswered };

  void addObstacle(const Superellipsoid& shape, double stamp, const TrackInflation& inflation);
  void addUav(std::size_t uav, double epoch, const UavRecord& record);
  void fillRequest(UavRecord& record, GuideRequest& request) const;

  const Parameters& parameters_;
  Workspace workspace_;
  double time_zero_ = 0.0;  ///< of the scene [s]
  GuideScene scene_;
  std::shared_ptr<const VoxelMap> last_map_;  ///< of the scene before; given back outside of the cycle
  std::vector<GuideRequest> requests_;
  std::vector<GuideAnswer> answers_;
  std::vector<double> quiet_since_;  ///< of each UAV [s]
  GuidePlanner planner_;
  std::atomic<Turn> turn_{Turn::kCycle};
};

}  // namespace swarm_planner
