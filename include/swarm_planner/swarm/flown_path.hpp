// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>

#include "swarm_planner/swarm/committed_motion.hpp"

namespace swarm_planner {

/// What a vehicle has been asked to fly in the last seconds, one committed motion after the other: where it was to be
/// when an old measurement was made. Takes no heap.
class FlownPath {
 public:
  /// Pieces of motion that are kept; at one or more per cycle some seconds.
  static constexpr std::size_t kMostPieces = 24;

  void clear() { count_ = 0; }
  /// `motion` was to be flown until `until` [s], from where the path ends so far, or from the motion's epoch.
  void append(const CommittedMotion& motion, double until);
  /// Whether the path is known at time `t` [s].
  bool covers(double t) const { return count_ > 0 && t >= piece(0).begin && t <= end_; }
  /// The state at a time that the path covers.
  KinematicState at(double t) const;

 private:
  struct Piece {
    double begin = 0.0;  ///< [s]
    KinematicState state;
    Vector3 jerk;
  };
  const Piece& piece(std::size_t i) const { return pieces_[(first_ + i) % kMostPieces]; }
  void push(const Piece& piece);

  std::array<Piece, kMostPieces> pieces_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  double end_ = 0.0;  ///< [s]
};

}  // namespace swarm_planner
