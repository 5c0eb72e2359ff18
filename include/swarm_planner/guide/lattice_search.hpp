// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "swarm_planner/guide/guide_path.hpp"

namespace swarm_planner {

/// What is asked of a search.
struct SearchQuery {
  Vector3 start = Vector3::Zero();  ///< [m]
  Vector3 goal = Vector3::Zero();   ///< [m]
  Pace pace;
  double cell = 1.0;  ///< of the lattice [m]
  Box region;         ///< the path stays inside [m]
  int budget = 0;     ///< most expansions
};

enum class SearchOutcome {
  kFound,
  kNoWay,       ///< none on this lattice
  kBudgetSpent  ///< there may be one
};

/// Searches the cheapest way from start to goal: A* on a cubic lattice about the start, whose axes lie along the way,
/// to the right of it and above. Parents are any points of the lattice in sight (lazy Theta*: Nash, Koenig and Tovey,
/// AAAI 2010), and the goal is looked for from every node that is expanded, so that ways are straight where they can
/// be. Every piece of a way has been found clear at the time at which it is flown. The cost is length plus traffic, and
/// the heuristic the distance to the goal. Draws go to the right. Fixed memory; the same query gives the same way.
class LatticeSearch {
 public:
  LatticeSearch();

  /// Fills `path`, from start to goal, if the outcome is kFound.
  SearchOutcome search(const SearchQuery& query, const FreeSpace& space, const Traffic& traffic, GuidePath& path);
  /// Of the last search.
  int expansions() const { return expansions_; }

 private:
  static constexpr std::size_t kMostNodes = 1U << 16U;
  static constexpr std::size_t kSlots = 2 * kMostNodes;
  static constexpr std::int32_t kNone = -1;

  using Place = std::array<std::int16_t, 3>;  ///< in cells from the start
  struct Node {
    Place place;
    bool closed = false;
    bool judged = false;   ///< it is known whether it is too near to something
    bool blocked = false;  ///< it is
    std::int32_t parent = kNone;
    double way = 0.0;                                       ///< from the start [m]
    double cost = std::numeric_limits<double>::infinity();  ///< way and traffic [m]
  };
  struct Open {
    double bound = 0.0;  ///< least cost of a way to the goal through the node, in millionths of a cell
    double cost = 0.0;   ///< of the node when it was put here
    std::int32_t node = kNone;
  };

  void begin(const SearchQuery& query);
  Vector3 position(const Place& place) const;
  TimedPoint arrival(const Node& node) const { return query_.pace.after(position(node.place), node.way); }
  /// Where the place is in the hash table, or would be.
  std::size_t slotOf(const Place& place) const;
  /// The node at the place; kNone if there is none.
  std::int32_t find(const Place& place) const;
  /// The node at the place, a new one if there is none yet; kNone if there is no room.
  std::int32_t findOrAdd(const Place& place);
  /// Makes sure that the node is in sight of its parent, or finds another parent among its neighbours. False if there
  /// is none.
  bool settleParent(Node& node);
  /// The node reached straight from `parent`.
  Node reachedFrom(std::int32_t parent, const Place& place) const;
  /// Whether a node is too near to something at the time at which it was reached first; later ones hardly differ, and
  /// no way goes anywhere that has not been found clear for its own time.
  bool isBlocked(Node& node, const TimedPoint& at) const;
  /// False if there is no room.
  bool expand(std::int32_t index);
  void push(std::int32_t index);
  /// False if the way has more points than a path.
  bool extract(GuidePath& path) const;

  SearchQuery query_;
  const FreeSpace* space_ = nullptr;
  const Traffic* traffic_ = nullptr;
  Matrix3 axes_ = Matrix3::Identity();
  std::vector<Node> nodes_;
  std::vector<std::int32_t> slots_;       ///< hash table of nodes by their places
  std::vector<std::uint32_t> slot_runs_;  ///< the search that filled the slot
  std::uint32_t run_ = 0;
  std::vector<Open> open_;  ///< a heap
  Node goal_;               ///< the cheapest way there so far
  int expansions_ = 0;
};

}  // namespace swarm_planner
