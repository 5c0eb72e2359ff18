// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/pair_watch.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "swarm_planner/obstacles/pair_ellipsoid.hpp"

namespace swarm_planner {
namespace {

/// Skin of the list over its reach: large enough that rebuilding is rare, small enough that the list stays short.
constexpr double kSkinShare = 0.5;

}  // namespace

PairWatch::PairWatch(double horizontal, double vertical)
    : horizontal_(horizontal), vertical_(vertical), min_squared_(std::numeric_limits<double>::infinity()) {}

const std::vector<PairWatch::Pair>& PairWatch::observe(const std::vector<Vector3>& positions) {
  entered_.clear();
  if (positions.size() < 2) return entered_;
  if (built_at_.empty()) measureAllPairs(positions);
  if (movedTooFar(positions)) rebuild(positions);
  inside_now_.clear();
  for (const Pair& pair : near_) look(pair, positions);
  std::set_difference(inside_now_.begin(), inside_now_.end(), inside_.begin(), inside_.end(),
                      std::back_inserter(entered_));
  inside_.swap(inside_now_);
  return entered_;
}

std::optional<double> PairWatch::minDistance() const {
  if (!std::isfinite(min_squared_)) return std::nullopt;
  return std::sqrt(min_squared_);
}

void PairWatch::measureAllPairs(const std::vector<Vector3>& positions) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      min_squared_ = std::min(min_squared_, (positions[i] - positions[j]).squaredNorm());
    }
  }
}

bool PairWatch::movedTooFar(const std::vector<Vector3>& positions) const {
  if (built_at_.empty()) return true;
  const double allowed_squared = 0.25 * skin_ * skin_;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if ((positions[i] - built_at_[i]).squaredNorm() > allowed_squared) return true;
  }
  return false;
}

void PairWatch::rebuild(const std::vector<Vector3>& positions) {
  const double reach = std::max({std::sqrt(min_squared_), horizontal_, vertical_});
  skin_ = kSkinShare * reach;
  const double edge = reach + skin_;
  cells_.clear();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    cells_.push_back({std::llround(std::floor(positions[i].x() / edge)),
                      std::llround(std::floor(positions[i].y() / edge)),
                      std::llround(std::floor(positions[i].z() / edge)), i});
  }
  std::sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) {
    return std::tie(a.x, a.y, a.z, a.uav) < std::tie(b.x, b.y, b.z, b.uav);
  });
  near_.clear();
  for (const Cell& cell : cells_) addNeighbours(cell, positions, edge);
  std::sort(near_.begin(), near_.end());
  built_at_ = positions;
}

void PairWatch::addNeighbours(const Cell& cell, const std::vector<Vector3>& positions, double reach) {
  const double reach_squared = reach * reach;
  for (long long x = cell.x - 1; x <= cell.x + 1; ++x) {
    for (long long y = cell.y - 1; y <= cell.y + 1; ++y) {
      // Cells are sorted with z last: the three of this column lie side by side.
      auto other = std::lower_bound(cells_.begin(), cells_.end(), std::make_tuple(x, y, cell.z - 1),
                                    [](const Cell& a, const std::tuple<long long, long long, long long>& b) {
                                      return std::make_tuple(a.x, a.y, a.z) < b;
                                    });
      for (; other != cells_.end() && other->x == x && other->y == y && other->z <= cell.z + 1; ++other) {
        if (other->uav <= cell.uav) continue;
        if ((positions[cell.uav] - positions[other->uav]).squaredNorm() <= reach_squared) {
          near_.emplace_back(cell.uav, other->uav);
        }
      }
    }
  }
}

void PairWatch::look(const Pair& pair, const std::vector<Vector3>& positions) {
  const Vector3 apart = positions[pair.first] - positions[pair.second];
  const double squared = apart.squaredNorm();
  min_squared_ = std::min(min_squared_, squared);
  const double longer_axis = std::max(horizontal_, vertical_);
  if (squared < longer_axis * longer_axis && pairGauge(apart, horizontal_, vertical_) < 1.0) {
    inside_now_.push_back(pair);
  }
}

}  // namespace swarm_planner
