// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/shortest_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

/// Points one cell apart on each axis, and the search over them. Two more nodes are the start and the goal.
class ShortestPath::Grid {
 public:
  Grid(const FreeSpace& space, double cell) : space_(space), cell_(cell, cell, 2.0 * cell) {
    const Vector3 size = space.box().max - space.box().min;
    for (int axis = 0; axis < 3; ++axis) {
      counts_[static_cast<std::size_t>(axis)] = 1 + static_cast<int>(std::floor(size[axis] / cell_[axis]));
    }
    points_ = counts_[0] * counts_[1] * counts_[2];
    const auto nodes = static_cast<std::size_t>(points_) + 2;
    clearance_.assign(nodes, std::numeric_limits<float>::quiet_NaN());
    nodes_.resize(nodes);
  }

  std::vector<Vector3> find(const Vector3& start, const Vector3& goal);

 private:
  struct Node {
    double g = kInfinity;  ///< length of the way here [m]
    int parent = -1;
    bool closed = false;
  };
  using Entry = std::pair<double, int>;  ///< estimated length of the path through a node, and the node

  int startNode() const { return points_; }
  int goalNode() const { return points_ + 1; }
  Node& node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  Vector3 position(int index) const;
  std::array<int, 3> cellOf(const Vector3& p) const;
  int indexOf(int x, int y, int z) const { return (z * counts_[1] + y) * counts_[0] + x; }
  double clearance(int index);
  bool sees(const Vector3& a, const Vector3& b);
  template <class Visit>
  void forNeighbours(int index, const Visit& visit);
  bool settle(int index);
  void open(int index, int parent);
  void expand(int index);

  const FreeSpace& space_;
  Vector3 cell_;  ///< distances of grid points [m]
  std::array<int, 3> counts_ = {};
  int points_ = 0;
  std::vector<float> clearance_;  ///< NaN: not known yet
  std::vector<Node> nodes_;
  std::vector<int> touched_;
  Vector3 start_ = Vector3::Zero(), goal_ = Vector3::Zero();
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

Vector3 ShortestPath::Grid::position(int index) const {
  if (index == startNode()) return start_;
  if (index == goalNode()) return goal_;
  const int x = index % counts_[0];
  const int y = index / counts_[0] % counts_[1];
  const int z = index / counts_[0] / counts_[1];
  return space_.box().min + cell_.cwiseProduct(Vector3(x, y, z));
}

/// The grid point nearest to `p`.
std::array<int, 3> ShortestPath::Grid::cellOf(const Vector3& p) const {
  std::array<int, 3> at = {};
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::round((p[axis] - space_.box().min[axis]) / cell_[axis]);
    at[static_cast<std::size_t>(axis)] =
        std::clamp(static_cast<int>(steps), 0, counts_[static_cast<std::size_t>(axis)] - 1);
  }
  return at;
}

double ShortestPath::Grid::clearance(int index) {
  float& known = clearance_[static_cast<std::size_t>(index)];
  if (std::isnan(known)) known = static_cast<float>(space_.clearance(position(index)));
  return static_cast<double>(known);
}

/// FreeSpace::isFree of the segment, with the clearance of grid points near by wherever that tells enough.
bool ShortestPath::Grid::sees(const Vector3& a, const Vector3& b) {
  const double length = (b - a).norm();
  for (double s = 0.0; s < length;) {
    const Vector3 p = a + (s / length) * (b - a);
    const auto [x, y, z] = cellOf(p);
    const int near = indexOf(x, y, z);
    const double known = clearance(near) - (p - position(near)).norm();
    if (known < cell_.x()) return space_.isFree(p, b);
    s += known;
  }
  return space_.isFree(b);
}

/// Grid points around it; for the start and the goal those within two cells, which in turn have it as a neighbour.
template <class Visit>
void ShortestPath::Grid::forNeighbours(int index, const Visit& visit) {
  const int reach = index < points_ ? 1 : 2;
  const auto [x, y, z] = cellOf(position(index));
  for (int k = std::max(z - reach, 0); k <= std::min(z + reach, counts_[2] - 1); ++k) {
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, counts_[1] - 1); ++j) {
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, counts_[0] - 1); ++i) {
        const int neighbour = indexOf(i, j, k);
        if (neighbour != index && clearance(neighbour) >= 0.0) visit(neighbour);
      }
    }
  }
  if (index >= points_) return;
  for (const int end : {startNode(), goalNode()}) {
    const Vector3 cells = (position(end) - position(index)).cwiseQuotient(cell_);
    if (cells.lpNorm<Eigen::Infinity>() <= 2.0) visit(end);
  }
}

/// Lazy Theta*: the parent was taken to be in sight. If it is not, the best neighbour that has been settled and is.
bool ShortestPath::Grid::settle(int index) {
  Node& here = node(index);
  const Vector3 p = position(index);
  if (here.parent >= 0 && !sees(position(here.parent), p)) {
    here.g = kInfinity;
    forNeighbours(index, [&](int neighbour) {
      const Node& other = node(neighbour);
      if (!other.closed) return;
      const double g = other.g + (position(neighbour) - p).norm();
      if (g >= here.g || !sees(position(neighbour), p)) return;
      here.g = g;
      here.parent = neighbour;
    });
  }
  here.closed = here.g < kInfinity;
  return here.closed;
}

void ShortestPath::Grid::open(int index, int parent) {
  Node& here = node(index);
  const double g = parent < 0 ? 0.0 : node(parent).g + (position(parent) - position(index)).norm();
  if (here.closed || g >= here.g) return;
  if (here.g == kInfinity) touched_.push_back(index);
  here.g = g;
  here.parent = parent;
  queue_.push({g + (goal_ - position(index)).norm(), index});
}

void ShortestPath::Grid::expand(int index) {
  const int parent = node(index).parent < 0 ? index : node(index).parent;
  forNeighbours(index, [&](int neighbour) { open(neighbour, parent); });
}

std::vector<Vector3> ShortestPath::Grid::find(const Vector3& start, const Vector3& goal) {
  for (const int index : touched_) node(index) = Node();
  touched_.clear();
  queue_ = {};
  start_ = start;
  goal_ = goal;
  open(startNode(), -1);
  while (!queue_.empty() && !node(goalNode()).closed) {
    const int index = queue_.top().second;
    queue_.pop();
    if (!node(index).closed && settle(index)) expand(index);
  }
  std::vector<Vector3> path;
  if (!node(goalNode()).closed) return path;
  for (int index = goalNode(); index >= 0; index = node(index).parent) path.push_back(position(index));
  std::reverse(path.begin(), path.end());
  return path;
}

ShortestPath::ShortestPath(const FreeSpace& space, double cell) : space_(space), cell_(cell) {}

ShortestPath::~ShortestPath() = default;

std::vector<Vector3> ShortestPath::find(const Vector3& start, const Vector3& goal) {
  if (!space_.isFree(start) || !space_.isFree(goal)) return {};
  if (space_.isFree(start, goal)) return {start, goal};
  if (!grid_) grid_ = std::make_unique<Grid>(space_, cell_);
  std::vector<Vector3> path = grid_->find(start, goal);
  return path.empty() ? path : tightened(space_, std::move(path), cell_);
}

}  // namespace swarm_planner
