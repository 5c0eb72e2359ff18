// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <deque>
#include <vector>

#include "swarm_planner/guide/guide_planner.hpp"

namespace swarm_planner {

/// Distance that the bodies of the tests demand [m].
constexpr double kTestDistance = 0.36;

GuideBody bodyOf(const Vector3& center, const Vector3& radii, double exponent,
                 const Vector3& velocity = Vector3::Zero());
Workspace roomOf(const Vector3& min, const Vector3& max);

/// A room with bodies to search in.
class SearchScene {
 public:
  explicit SearchScene(const Workspace& room);

  void add(const GuideBody& body);
  /// Searches at 3 m/s.
  SearchOutcome search(const Vector3& start, const Vector3& goal, double cell, int budget = 20000);
  const BodySpace& space() const { return space_; }
  const GuidePath& path() const { return path_; }
  Traffic& traffic() { return traffic_; }
  int expansions() const { return lattice_.expansions(); }
  /// Least distance of the path, flown at 3 m/s, to what must be kept clear of, looked at every centimetre [m].
  double leastClearance() const;

  static constexpr double kSpeed = 3.0;

 private:
  std::deque<GuideBody> bodies_;
  BodySpace space_;
  Traffic traffic_;
  LatticeSearch lattice_;
  GuidePath path_;
};

/// A swarm of one, or more, that asks for guides round by round.
struct GuideRounds {
  explicit GuideRounds(std::size_t uavs = 1);

  /// The UAV follows a line from `start` to `end` and is at `position`.
  void follow(std::size_t uav, const Vector3& start, const Vector3& end, const Vector3& position);
  const GuideAnswer& round();

  GuideSettings settings;
  GuideScene scene;
  std::vector<GuideRequest> requests;
  std::vector<GuideAnswer> answers;
  GuidePlanner planner;
};

}  // namespace swarm_planner
