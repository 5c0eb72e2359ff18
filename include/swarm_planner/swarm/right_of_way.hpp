// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/swarm/mission.hpp"
#include "swarm_planner/swarm/neighbour_lists.hpp"
#include "swarm_planner/swarm/uav_record.hpp"
#include "swarm_planner/swarm/wayside.hpp"

namespace swarm_planner {

/// Who goes first where UAVs block each other's ways: doc/deadlock.md has the rule and why it ends every deadlock for
/// which there is room. UAVs rank by the time that they have been on their way, ties by index. One that has hardly
/// moved for a while although its target leads on, with others standing in its way, has those among them that rank
/// lower leave its way for a place aside, until it is past; those that have arrived, too. In turn they may have others
/// leave theirs, with the rank of the first. Takes no heap within a cycle; its cost is that of looking at each UAV
/// once, and at the neighbours of those that are held up.
class RightOfWay {
 public:
  /// `parameters` must outlive this.
  RightOfWay(const Mission& mission, const Parameters& parameters);

  /// Once all starts are known. `judged`: of each UAV's odometry; kNone if it can be planned from. `map`: what is
  /// mapped, or null.
  void direct(double epoch, const std::vector<TrackedObstacle>& obstacles, const std::vector<Reason>& judged,
              const NeighbourLists& neighbours, std::vector<UavRecord>& uavs, const VoxelMap* map = nullptr);

 private:
  /// Of a UAV that stands in the way.
  struct Blocker {
    std::size_t uav;
    double distance;  ///< [m]
  };
  /// A place in the order: the earlier goes first, then the smaller index.
  struct Rank {
    double since;
    std::size_t uav;
    bool precedes(const Rank& other) const { return since != other.since ? since < other.since : uav < other.uav; }
  };

  /// Brings the UAV's state up to date. True if it is held up.
  bool watch(std::size_t i, const Reason& judged);
  bool isOver(const UavRecord& uav) const;
  /// Whether it has given way for long, and the other one still stands where it stood.
  bool isInVain(const UavRecord& uav) const;
  void resolve(std::size_t i, const NeighbourLists& neighbours);
  void findBlockers(std::size_t i, const Way& way, const NeighbourLists& neighbours);
  /// Asks UAV `j` to leave the way of UAV i. False if it has no place to go.
  bool ask(std::size_t i, std::size_t j, const NeighbourLists& neighbours);
  bool mayAsk(std::size_t i, std::size_t j) const;
  /// Whether UAV i gives way to UAV j, or to one that does, and so on: asked in turn, j would never be past.
  bool givesWayTo(std::size_t i, std::size_t j) const;
  /// Whether the references' ends are too close for both to be there, and j has got to where it stays, hardly farther
  /// from its end than i is from its own.
  bool sharesEnd(std::size_t i, std::size_t j) const;
  bool isSettled(const TrafficState& traffic) const;
  /// Its own rank, or that which it has inherited.
  Rank rankOf(std::size_t i) const;
  Way wayOf(std::size_t i) const;

  const Parameters& parameters_;
  double tolerance_;  ///< of having arrived [m]
  double patience_;   ///< time without progress before a UAV asks others to move [s]
  Wayside wayside_;
  double epoch_ = 0.0;
  double last_epoch_ = 0.0;
  std::vector<UavRecord>* uavs_ = nullptr;  ///< in the cycle
  std::vector<std::size_t> held_up_;
  std::vector<Blocker> blockers_;
  int searches_ = 0;  ///< in this cycle
};

/// What the UAV does because of another one, as the reason, where it flies a new plan and nothing else is told.
void reportTraffic(const TrafficState& traffic, UavReport& report);

}  // namespace swarm_planner
