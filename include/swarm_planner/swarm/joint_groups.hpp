// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swarm_planner/solver/joint_qp.hpp"
#include "swarm_planner/swarm/neighbour_lists.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/thread_team.hpp"

namespace swarm_planner {

/// Divides a swarm into groups of at most kMostJointUavs UAVs that are planned for at once; a UAV that is in no group
/// is one of its own. The same for any number of threads.
class JointGroups {
 public:
  /// Memory for `uavs` UAVs.
  explicit JointGroups(std::size_t uavs);

  /// What is to be known of a UAV besides where it is.
  struct Candidate {
    bool may_be_grouped = false;
    Vector3 end = Vector3::Zero();  ///< of its reference [m]
  };

  /// One group of all UAVs that may be grouped, which are no more than fit. Of those whose ends leave no room for all
  /// the first is in it, the others take turns: at once they would meet around the end, and none would get there.
  void buildOne(const std::vector<Candidate>& candidates, const Surroundings& surroundings);

  /// UAVs interact strongly if their motions come closer within the horizon than kStrong times the distance that they
  /// have to keep. Pairs that do are joined, the closest first, as long as the group that comes out is not too large;
  /// of one UAV no more pairs count than fit into a group, its closest. Pairs whose ends leave no room for both take
  /// turns: at once they would meet half-way, and neither would arrive.
  void build(const std::vector<Candidate>& candidates, const Surroundings& surroundings, ThreadTeam& team);

  std::size_t count() const { return begin_.size() - 1; }
  /// The UAVs of a group: begin(group)[0] .. begin(group)[size(group) - 1], ascending.
  const std::size_t* begin(std::size_t group) const { return members_.data() + begin_[group]; }
  std::size_t size(std::size_t group) const { return begin_[group + 1] - begin_[group]; }
  std::size_t groupOf(std::size_t uav) const { return group_of_[uav]; }
  /// Groups of which some UAVs may meet.
  const NeighbourLists& neighbours() const { return neighbours_; }

  static constexpr double kStrong = 1.5;

 private:
  static constexpr std::size_t kMostPartners = kMostJointUavs - 1;
  struct Pair {
    double gauge = 0.0;  ///< least one of the pair ellipsoid within the horizon
    std::uint32_t first = 0, second = 0;
  };
  struct Partners {
    std::array<Pair, kMostPartners> pairs;  ///< the closest first
    std::size_t count = 0;
  };

  static bool excludeEachOther(const Candidate& a, const Candidate& b, const Surroundings& surroundings);
  void findPartners(std::size_t uav, const std::vector<Candidate>& candidates, const Surroundings& surroundings);
  void joinPairs();
  std::size_t rootOf(std::size_t uav);
  /// Lists the groups, whose members have one root.
  void list(const Surroundings& surroundings);

  std::vector<Partners> partners_;  ///< of each UAV
  std::vector<Pair> pairs_;
  std::vector<std::size_t> parent_, size_;  ///< a forest: UAVs of one group have one root
  std::vector<std::size_t> group_of_, begin_, members_;
  std::vector<Box> areas_;  ///< where the UAVs of each group may be [m]
  NeighbourLists neighbours_;
};

}  // namespace swarm_planner
