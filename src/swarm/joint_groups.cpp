// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/joint_groups.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace swarm_planner {

JointGroups::JointGroups(std::size_t uavs) : partners_(uavs), parent_(uavs), size_(uavs), group_of_(uavs) {
  pairs_.reserve(uavs * kMostPartners);
  begin_.reserve(uavs + 1);
  members_.reserve(uavs);
  areas_.reserve(uavs);
  neighbours_.reserve(uavs);
}

void JointGroups::buildOne(const std::vector<Candidate>& candidates, const Surroundings& surroundings) {
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  const auto first = std::find_if(candidates.begin(), candidates.end(),
                                  [](const Candidate& candidate) { return candidate.may_be_grouped; });
  const auto root = static_cast<std::size_t>(first - candidates.begin());
  for (std::size_t i = root + 1; i < candidates.size(); ++i) {
    bool fits = candidates[i].may_be_grouped;
    for (std::size_t member = root; member < i && fits; ++member) {
      fits = parent_[member] != root || !excludeEachOther(candidates[i], candidates[member], surroundings);
    }
    if (fits) parent_[i] = root;
  }
  list(surroundings);
}

void JointGroups::build(const std::vector<Candidate>& candidates, const Surroundings& surroundings, ThreadTeam& team) {
  team.forEach(0, partners_.size(), [&](std::size_t i, std::size_t) { findPartners(i, candidates, surroundings); });
  joinPairs();
  list(surroundings);
}

bool JointGroups::excludeEachOther(const Candidate& a, const Candidate& b, const Surroundings& surroundings) {
  return surroundings.pairGauge(a.end - b.end) < 1.0;
}

void JointGroups::findPartners(std::size_t uav, const std::vector<Candidate>& candidates,
                               const Surroundings& surroundings) {
  Partners& partners = partners_[uav];
  partners.count = 0;
  if (!candidates[uav].may_be_grouped) return;
  for (const std::uint32_t other : surroundings.neighbours().of(uav)) {
    if (!candidates[other].may_be_grouped) continue;
    if (excludeEachOther(candidates[uav], candidates[other], surroundings)) continue;
    const double gauge = surroundings.leastPairGauge(uav, other, kStrong);
    if (!(gauge < kStrong)) continue;
    const auto begin = partners.pairs.begin();
    auto place = begin + static_cast<std::ptrdiff_t>(partners.count);
    while (place != begin && gauge < (place - 1)->gauge) --place;
    if (place == partners.pairs.end()) continue;
    partners.count = std::min(partners.count + 1, kMostPartners);
    std::move_backward(place, begin + static_cast<std::ptrdiff_t>(partners.count) - 1,
                       begin + static_cast<std::ptrdiff_t>(partners.count));
    const auto self = static_cast<std::uint32_t>(uav);
    *place = {gauge, std::min(self, other), std::max(self, other)};
  }
}

void JointGroups::joinPairs() {
  pairs_.clear();
  for (const Partners& partners : partners_) {
    pairs_.insert(pairs_.end(), partners.pairs.begin(),
                  partners.pairs.begin() + static_cast<std::ptrdiff_t>(partners.count));
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.gauge, a.first, a.second) < std::tie(b.gauge, b.first, b.second);
  });
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  std::fill(size_.begin(), size_.end(), std::size_t{1});
  for (const Pair& pair : pairs_) {
    const std::size_t a = rootOf(pair.first), b = rootOf(pair.second);
    if (a == b || size_[a] + size_[b] > kMostJointUavs) continue;
    parent_[std::max(a, b)] = std::min(a, b);
    size_[std::min(a, b)] = size_[a] + size_[b];
  }
}

std::size_t JointGroups::rootOf(std::size_t uav) {
  while (parent_[uav] != uav) uav = parent_[uav];
  return uav;
}

void JointGroups::list(const Surroundings& surroundings) {
  const std::size_t uavs = parent_.size();
  begin_.assign(1, 0);
  areas_.clear();
  // A group's root is its first UAV.
  for (std::size_t i = 0; i < uavs; ++i) {
    const std::size_t root = rootOf(i);
    if (root == i) {
      group_of_[i] = areas_.size();
      areas_.push_back(surroundings.area(i));
      begin_.push_back(0);
    }
    const std::size_t group = group_of_[i] = group_of_[root];
    areas_[group].min = areas_[group].min.cwiseMin(surroundings.area(i).min);
    areas_[group].max = areas_[group].max.cwiseMax(surroundings.area(i).max);
    ++begin_[group + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  members_.resize(uavs);
  for (std::size_t i = uavs; i-- > 0;) members_[--begin_[group_of_[i] + 1]] = i;
  std::rotate(begin_.begin(), begin_.begin() + 1, begin_.end());
  begin_.back() = uavs;
  neighbours_.build(areas_);
}

}  // namespace swarm_planner
