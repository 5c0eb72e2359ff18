// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/swarm/flight_commands.hpp"
#include "swarm_planner/swarm/landing_sites.hpp"
#include "swarm_planner/swarm/mission.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {

/// Turns modes into what is flown: where a UAV holds, the way of its landing, and when it has landed. Throughout a
/// cycle it takes no heap.
///
/// Every map is what is mapped in the cycle, or null.
class FlightDirector {
 public:
  /// `parameters` must outlive this.
  FlightDirector(const Mission& mission, const Parameters& parameters);

  /// For one UAV with usable odometry, once record.start is known: the way on in its mode. Several UAVs may be directed
  /// at the same time.
  void direct(double epoch, const UavMeasurement& measured, UavRecord& record, const VoxelMap* map = nullptr) const;

  /// Gives sites to UAVs that land and have none yet, from the lowest up, and takes those away that something has
  /// come upon. `judged`: of each UAV's odometry; kNone if it can be planned from. In a cycle only as many UAVs as
  /// there is time for.
  void assignSites(double epoch, const std::vector<TrackedObstacle>& obstacles, const std::vector<Reason>& judged,
                   std::vector<UavRecord>& uavs, const VoxelMap* map = nullptr);

 private:
  /// Whether, and how far, the UAV may be below the workspace.
  void lookAtFloor(UavRecord& record) const;
  /// Moves the place of rest along while the UAV is not slow yet, so that it need not turn back. True from the cycle on
  /// that follows.
  bool brake(double epoch, UavRecord& record) const;
  void hold(double epoch, UavRecord& record) const;
  void land(double epoch, const UavMeasurement& measured, UavRecord& record, const VoxelMap* map) const;
  /// Whether a UAV that comes lower than `place` is too near to what is mapped.
  bool isAtFloor(const VoxelMap* map, const Vector3& place) const;
  void descend(double epoch, const UavMeasurement& measured, UavRecord& record, const VoxelMap* map) const;
  /// Where the UAV comes to rest: braking with room, or as quickly as it can.
  Vector3 placeOfRest(double epoch, const UavRecord& record, bool quickest) const;
  /// Another site is needed, from where the UAV comes to rest.
  static void giveUpSite(double epoch, UavRecord& record);
  double descentSpeed() const;  ///< [m/s]
  void takeColumns(const std::vector<UavRecord>& uavs);
  void releaseBlockedSites(double epoch, const std::vector<Reason>& judged, std::vector<UavRecord>& uavs);

  const Parameters& parameters_;
  FlightBounds bounds_;
  double approach_speed_;  ///< [m/s]
  LandingSites sites_;
  std::vector<std::size_t> waiting_;  ///< for a site
  std::size_t next_check_ = 0;        ///< of a site that was given
};

}  // namespace swarm_planner
