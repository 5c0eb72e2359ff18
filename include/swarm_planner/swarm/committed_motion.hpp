// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>

#include "swarm_planner/problem/segment.hpp"
#include "swarm_planner/swarm/bernstein.hpp"
#include "swarm_planner/swarm/stopping.hpp"

namespace swarm_planner {

/// What a UAV does if nothing more is commanded: its plan, then its stop, then rest for good. Cubic pieces of equal
/// length from an epoch on, with what others need to keep clear of them: Bernstein points and boxes. Takes no heap.
///
/// Times are in seconds after the epoch: exact where an absolute time of 1e9 s rounds to 2e-7 s. "Piece" pieces() is
/// the rest.
class CommittedMotion {
 public:
  static constexpr int kMaxPieces = kHorizon + kMaxStopStages;
  /// Pieces that share a box of their own.
  static constexpr int kGroup = 5;
  /// Knots of two motions closer than this are the same [s].
  static constexpr double kTimeTolerance = 1e-9;

  /// Rests at the origin.
  CommittedMotion() { assignRest(0.0, Vector3::Zero()); }
  /// `stop` begins where `plan` ends, with the same dt.
  void assign(const Trajectory& plan, const StopManoeuvre& stop);
  /// Brakes at once.
  void assignStop(double epoch, const StopManoeuvre& stop);
  void assignRest(double epoch, const Vector3& position);
  /// How many pieces have ended by `t` [s].
  int endedPieces(double t) const;
  /// `pieces` (at most kMaxPieces) of length `dt` with the control points `points`, 3 pieces + 1: as piece() gives
  /// them.
  void assignPoints(double epoch, double dt, int pieces, const Vector3* points);
  /// Forgets the first `count` pieces (at most all): what is left begins at a later epoch.
  void dropPieces(int count);
  /// Forgets the pieces that have ended by `t` [s]; a rest begins anew there.
  void moveTo(double t);

  double epoch() const { return epoch_; }  ///< [s]
  double dt() const { return dt_; }        ///< length of a piece [s]
  int pieces() const { return pieces_; }
  /// From the epoch until rest [s].
  double duration() const { return pieces_ * dt_; }
  const Vector3& start() const { return points_[0]; }
  const Vector3& restingPlace() const { return points_[3 * static_cast<std::size_t>(pieces_)]; }
  /// False if some number in it is not finite: nothing else may be asked then.
  bool isFinite() const { return finite_; }

  /// Control points of piece k; those of the rest are all the same.
  BernsteinPoints<4> piece(int k) const {
    if (k >= pieces_) return {restingPlace(), restingPlace(), restingPlace(), restingPlace()};
    const Vector3* first = &points_[3 * static_cast<std::size_t>(k)];
    return {first[0], first[1], first[2], first[3]};
  }
  /// The constant jerk of piece k, zero of the rest [m/s^3].
  Vector3 jerk(int k) const;
  /// The state `elapsed` seconds after the epoch; before it the first piece is followed back.
  KinematicState after(double elapsed) const;
  /// The state at absolute time `t` [s].
  KinematicState at(double t) const { return after(t - epoch_); }

  /// Contains the whole motion from the epoch on [m].
  const Box& box() const { return box_; }
  /// Contains piece k, the rest included [m].
  const Box& pieceBox(int k) const { return piece_boxes_[static_cast<std::size_t>(k < pieces_ ? k : pieces_)]; }
  /// Contains pieces kGroup g .. kGroup g + kGroup - 1 [m].
  const Box& groupBox(int g) const { return group_boxes_[static_cast<std::size_t>(g)]; }
  /// Contains the motion over [begin, end], 0 <= begin, but for kTimeTolerance at either end, and not much more: made
  /// of the boxes of pieces or groups.
  Box boxOver(double begin, double end) const;

 private:
  void appendPieces(const KinematicState* knots, int count);
  void finish();

  static constexpr std::size_t kMostGroups = (kMaxPieces + kGroup - 1) / kGroup;

  double epoch_ = 0.0;
  double dt_ = 1.0;
  int pieces_ = 0;
  bool finite_ = true;
  Box box_;
  std::array<Box, kMostGroups> group_boxes_;
  std::array<Box, kMaxPieces + 1> piece_boxes_;
  std::array<Vector3, 3 * kMaxPieces + 1> points_;
};

}  // namespace swarm_planner
