// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <optional>

#include "swarm_planner/swarm/committed_motion.hpp"
#include "swarm_planner/swarm/flown_path.hpp"

namespace swarm_planner {

/// The motions that one UAV may be flying: the newest that was committed and, should its setpoints have been lost, the
/// one that it was flying before. Odometry tells which of them it is.
class MotionMemory {
 public:
  void clear();
  bool empty() const { return count_ == 0; }

  /// The newest motion; not if empty.
  const CommittedMotion& newest() const { return motions_[newest_]; }
  /// What is flown if the newest one did not arrive; null if there is none.
  const CommittedMotion* older() const { return count_ > 1 ? &motions_[1 - newest_] : nullptr; }
  /// The same in the cycle of `epoch` [s], while it may be flown: a motion that goes on is sent again in every cycle of
  /// `period` [s], and not every time in vain.
  const CommittedMotion* olderInFlight(double epoch, double period) const {
    return newest_since_ > epoch - 1.5 * period ? older() : nullptr;
  }
  /// What the UAV flies as far as is known; not if empty.
  const CommittedMotion& flown() const { return on_older_ ? motions_[1 - newest_] : newest(); }
  /// Whether odometry has shown that the newest motion did not arrive.
  bool newestIsLost() const { return on_older_; }

  /// The state that the UAV was to have at `t` [s]; empty if that is longer ago than is remembered.
  std::optional<KinematicState> expectedAt(double t) const;
  /// Finds out which motion is flown: the older one if position `p` [m] at `stamp` [s] is nearer to it than to the
  /// newest one by more than `difference` [m].
  void compare(double stamp, const Vector3& p, double difference);

  /// Starts anew: the UAV flew `past` until motion.epoch(), and is to fly `motion` from then on.
  void begin(const CommittedMotion& past, const CommittedMotion& motion);
  /// As another planner left it: commit(older), if there is one, then commit(newest).
  void restore(const CommittedMotion& newest, const CommittedMotion* older);
  /// Of two motions that may be flown since long ago forgets the one that position `p` [m] at `stamp` [s] is farther
  /// from, even if hardly.
  void keepNearest(double stamp, const Vector3& p);

  /// From motion.epoch() on the UAV is to fly `motion`.
  void commit(const CommittedMotion& motion);
  /// The UAV has been found elsewhere: from motion.epoch() on it is to fly `motion`, and where it was to be before is
  /// forgotten. What it was flying stays as what it may fly if `motion` does not arrive.
  void startAnew(const CommittedMotion& motion);
  /// The UAV goes on with what it flies. Pieces that have ended by `epoch` [s] are forgotten; a rest begins anew there.
  void goOn(double epoch);

 private:
  void push(const CommittedMotion& motion);
  void forgetLost();

  std::array<CommittedMotion, 2> motions_;
  std::size_t newest_ = 0;
  int count_ = 0;
  bool on_older_ = false;
  double newest_since_ = 0.0;  ///< its epoch when it was committed [s]
  FlownPath path_;             ///< before flown()
};

}  // namespace swarm_planner
