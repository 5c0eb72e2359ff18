// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/lattice_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {
namespace {

constexpr double kVertical = 1e-3;  // horizontal part of a direction below which it counts as vertical
constexpr double kSameCost = 1e-6;  // of a cell: costs that differ by less are the same
constexpr int kFarthest = 30000;    // cells from the start

using Step = std::array<std::int16_t, 3>;

/// The 26 neighbours of a lattice point; ahead, right and above come first.
const std::array<Step, 26>& steps() {
  static const std::array<Step, 26> all = [] {
    std::array<Step, 26> list{};
    std::size_t count = 0;
    for (const std::int16_t ahead : {1, 0, -1}) {
      for (const std::int16_t right : {1, 0, -1}) {
        for (const std::int16_t above : {1, 0, -1}) {
          if (ahead != 0 || right != 0 || above != 0) list[count++] = {ahead, right, above};
        }
      }
    }
    return list;
  }();
  return all;
}

template <class Place>
Place moved(const Place& place, const Step& step) {
  return {static_cast<std::int16_t>(place[0] + step[0]), static_cast<std::int16_t>(place[1] + step[1]),
          static_cast<std::int16_t>(place[2] + step[2])};
}

/// Axes along `way`, to the right of it, and above, as columns.
Matrix3 axesAlong(const Vector3& way) {
  Matrix3 axes;
  const double length = way.norm();
  const Vector3 along = length > 0.0 ? Vector3(way / length) : Vector3(Vector3::UnitX());
  const Vector3 across = along.cross(upward());
  const Vector3 right = across.norm() > kVertical ? Vector3(across.normalized()) : Vector3(Vector3::UnitY());
  axes << along, right, right.cross(along);
  return axes;
}

/// Of equal bounds the node nearest to the goal comes first, of equal nodes the one that was found first.
template <class Open>
bool comesLater(const Open& a, const Open& b) {
  if (a.bound != b.bound) return a.bound > b.bound;
  return a.cost != b.cost ? a.cost < b.cost : a.node > b.node;
}

bool contains(const Box& box, const Vector3& p) {
  return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
}

}  // namespace

LatticeSearch::LatticeSearch() : slots_(kSlots, kNone), slot_runs_(kSlots, 0) {
  nodes_.reserve(kMostNodes);
  open_.reserve(4 * kMostNodes);
}

void LatticeSearch::begin(const SearchQuery& query) {
  query_ = query;
  axes_ = axesAlong(query.goal - query.start);
  nodes_.clear();
  open_.clear();
  goal_ = Node();
  expansions_ = 0;
  if (++run_ == 0) {
    std::fill(slot_runs_.begin(), slot_runs_.end(), 0U);
    run_ = 1;
  }
}

Vector3 LatticeSearch::position(const Place& place) const {
  return query_.start + query_.cell * (axes_ * Vector3(place[0], place[1], place[2]));
}

std::size_t LatticeSearch::slotOf(const Place& place) const {
  const auto hash = static_cast<std::size_t>(place[0] + kFarthest) * 73856093U ^
                    static_cast<std::size_t>(place[1] + kFarthest) * 19349663U ^
                    static_cast<std::size_t>(place[2] + kFarthest) * 83492791U;
  std::size_t slot = hash % kSlots;
  while (slot_runs_[slot] == run_ && nodes_[static_cast<std::size_t>(slots_[slot])].place != place) {
    slot = (slot + 1) % kSlots;
  }
  return slot;
}

std::int32_t LatticeSearch::find(const Place& place) const {
  const std::size_t slot = slotOf(place);
  return slot_runs_[slot] == run_ ? slots_[slot] : kNone;
}

std::int32_t LatticeSearch::findOrAdd(const Place& place) {
  const std::size_t slot = slotOf(place);
  if (slot_runs_[slot] == run_) return slots_[slot];
  if (nodes_.size() == kMostNodes) return kNone;
  slots_[slot] = static_cast<std::int32_t>(nodes_.size());
  slot_runs_[slot] = run_;
  nodes_.emplace_back();
  nodes_.back().place = place;
  return slots_[slot];
}

LatticeSearch::Node LatticeSearch::reachedFrom(std::int32_t parent, const Place& place) const {
  const Node& from = nodes_[static_cast<std::size_t>(parent)];
  Node node;
  node.place = place;
  node.parent = parent;
  node.way = from.way + (position(place) - position(from.place)).norm();
  node.cost = from.cost + (node.way - from.way) + traffic_->cost(arrival(from), arrival(node));
  return node;
}

bool LatticeSearch::settleParent(Node& node) {
  if (node.parent == kNone) return true;
  if (space_->isClear(arrival(nodes_[static_cast<std::size_t>(node.parent)]), arrival(node))) return true;
  Node best = node;
  best.parent = kNone;
  best.cost = std::numeric_limits<double>::infinity();
  for (const Step& step : steps()) {
    const std::int32_t neighbour = find(moved(node.place, step));
    if (neighbour == kNone || !nodes_[static_cast<std::size_t>(neighbour)].closed) continue;
    const Node candidate = reachedFrom(neighbour, node.place);
    if (candidate.cost >= best.cost) continue;
    if (!space_->isClear(arrival(nodes_[static_cast<std::size_t>(neighbour)]), arrival(candidate))) continue;
    best.parent = neighbour;
    best.way = candidate.way;
    best.cost = candidate.cost;
  }
  node = best;
  return node.parent != kNone;
}

void LatticeSearch::push(std::int32_t index) {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  const double bound = node.cost + (query_.goal - position(node.place)).norm();
  open_.push_back({std::round(bound / (kSameCost * query_.cell)), node.cost, index});
  std::push_heap(open_.begin(), open_.end(), comesLater<Open>);
}

bool LatticeSearch::isBlocked(Node& node, const TimedPoint& at) const {
  if (!node.judged) node.blocked = space_->clearance(at) < 0.0;
  node.judged = true;
  return node.blocked;
}

bool LatticeSearch::expand(std::int32_t index) {
  nodes_[static_cast<std::size_t>(index)].closed = true;
  const Node node = nodes_[static_cast<std::size_t>(index)];
  Node at_goal;
  at_goal.way = node.way + (query_.goal - position(node.place)).norm();
  const TimedPoint end = query_.pace.after(query_.goal, at_goal.way);
  at_goal.cost = node.cost + (at_goal.way - node.way) + traffic_->cost(arrival(node), end);
  at_goal.parent = index;
  if (at_goal.cost < goal_.cost && space_->isClear(arrival(node), end)) goal_ = at_goal;

  // In open space the parent of a node is in sight of its neighbours, too.
  const std::int32_t parent = node.parent == kNone ? index : node.parent;
  for (const Step& step : steps()) {
    const Place place = moved(node.place, step);
    if (std::abs(place[0]) > kFarthest || std::abs(place[1]) > kFarthest || std::abs(place[2]) > kFarthest) continue;
    if (!contains(query_.region, position(place))) continue;
    const std::int32_t known = findOrAdd(place);
    if (known == kNone) return false;
    Node& neighbour = nodes_[static_cast<std::size_t>(known)];
    if (neighbour.closed) continue;
    const Node candidate = reachedFrom(parent, place);
    if (candidate.cost >= neighbour.cost || isBlocked(neighbour, arrival(candidate))) continue;
    neighbour.parent = candidate.parent;
    neighbour.way = candidate.way;
    neighbour.cost = candidate.cost;
    push(known);
  }
  return true;
}

SearchOutcome LatticeSearch::search(const SearchQuery& query, const FreeSpace& space, const Traffic& traffic,
                                    GuidePath& path) {
  begin(query);
  space_ = &space;
  traffic_ = &traffic;
  nodes_[static_cast<std::size_t>(findOrAdd(Place{}))].cost = 0.0;
  push(0);
  bool has_room = true;
  while (!open_.empty() && has_room && expansions_ < query.budget) {
    std::pop_heap(open_.begin(), open_.end(), comesLater<Open>);
    const Open next = open_.back();
    open_.pop_back();
    Node& node = nodes_[static_cast<std::size_t>(next.node)];
    if (node.closed || next.cost != node.cost) continue;
    if (goal_.cost <= next.bound * kSameCost * query.cell) break;
    if (!settleParent(node)) continue;
    if (node.cost > next.cost) {
      push(next.node);
      continue;
    }
    ++expansions_;
    has_room = expand(next.node) && open_.size() + steps().size() < open_.capacity();
  }
  if (goal_.parent != kNone) return extract(path) ? SearchOutcome::kFound : SearchOutcome::kNoWay;
  return open_.empty() ? SearchOutcome::kNoWay : SearchOutcome::kBudgetSpent;
}

bool LatticeSearch::extract(GuidePath& path) const {
  path.count = 0;
  path.append(query_.goal);
  for (std::int32_t i = goal_.parent; i != kNone; i = nodes_[static_cast<std::size_t>(i)].parent) {
    if (path.count + 2 > GuidePath::kMostPoints) return false;  // room for where the UAV is then, and its foot
    path.append(position(nodes_[static_cast<std::size_t>(i)].place));
  }
  std::reverse(path.points.begin(), path.points.begin() + static_cast<std::ptrdiff_t>(path.count));
  return true;
}

}  // namespace swarm_planner
