// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/solve_order.hpp"

#include <algorithm>

namespace swarm_planner {

void SolveOrder::reserve(std::size_t uavs) {
  round_of_.reserve(uavs);
  round_begin_.reserve(uavs + 1);
  order_.reserve(uavs);
}

void SolveOrder::build(const NeighbourLists& neighbours, std::size_t first) {
  const std::size_t count = neighbours.size();
  const auto turnOf = [=](std::size_t uav) { return uav >= first ? uav - first : uav + count - first; };
  const auto uavAt = [=](std::size_t turn) { return turn + first < count ? turn + first : turn + first - count; };
  round_of_.assign(count, 0);
  std::uint32_t rounds = 0;
  for (std::size_t turn = 0; turn < count; ++turn) {
    const std::size_t uav = uavAt(turn);
    for (const std::uint32_t other : neighbours.of(uav)) {
      if (turnOf(other) < turn) round_of_[uav] = std::max(round_of_[uav], round_of_[other] + 1);
    }
    rounds = std::max(rounds, round_of_[uav] + 1);
  }
  // Counting sort by round; within a round by turn.
  round_begin_.assign(rounds + 1, 0);
  for (const std::uint32_t round : round_of_) ++round_begin_[round + 1];
  for (std::size_t r = 0; r < rounds; ++r) round_begin_[r + 1] += round_begin_[r];
  order_.resize(count);
  for (std::size_t turn = count; turn-- > 0;) {
    const std::size_t uav = uavAt(turn);
    order_[--round_begin_[round_of_[uav] + 1]] = static_cast<std::uint32_t>(uav);
  }
  for (std::size_t r = 0; r < rounds; ++r) round_begin_[r] = round_begin_[r + 1];
  round_begin_[rounds] = static_cast<std::uint32_t>(count);
}

}  // namespace swarm_planner
