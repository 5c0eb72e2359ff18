// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swarm_planner/swarm/neighbour_lists.hpp"

namespace swarm_planner {

/// Sorts the UAVs of Problem 2 into rounds. UAVs take turns by index from a first one on, cyclically. Every UAV comes
/// in a later round than all neighbours whose turn is earlier, so that solving a round's UAVs in any order or at once
/// gives what solving all one by one gives.
class SolveOrder {
 public:
  /// Memory for `uavs` UAVs.
  void reserve(std::size_t uavs);
  void build(const NeighbourLists& neighbours, std::size_t first);

  std::size_t rounds() const { return round_begin_.size() - 1; }
  /// UAVs of round r: uav(roundBegin(r)) .. uav(roundBegin(r + 1) - 1), by turn.
  std::size_t roundBegin(std::size_t round) const { return round_begin_[round]; }
  std::size_t uav(std::size_t position) const { return order_[position]; }

 private:
  std::vector<std::uint32_t> round_of_;
  std::vector<std::uint32_t> round_begin_{0};
  std::vector<std::uint32_t> order_;
};

}  // namespace swarm_planner
