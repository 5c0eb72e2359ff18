// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/flown_path.hpp"

#include <algorithm>

namespace swarm_planner {

void FlownPath::append(const CommittedMotion& motion, double until) {
  const double from = count_ > 0 && end_ > motion.epoch() ? end_ : motion.epoch();
  if (until <= from + CommittedMotion::kTimeTolerance) return;
  const double elapsed = (from - motion.epoch() + CommittedMotion::kTimeTolerance) / motion.dt();
  int k = static_cast<int>(std::min(elapsed, static_cast<double>(motion.pieces())));
  for (double begin = from; begin < until - CommittedMotion::kTimeTolerance; ++k) {
    push({begin, motion.at(begin), motion.jerk(k)});
    if (k >= motion.pieces()) break;
    begin = motion.epoch() + (k + 1) * motion.dt();
  }
  end_ = until;
}

void FlownPath::push(const Piece& piece) {
  if (count_ == kMostPieces) {
    first_ = (first_ + 1) % kMostPieces;
    --count_;
  }
  pieces_[(first_ + count_) % kMostPieces] = piece;
  ++count_;
}

KinematicState FlownPath::at(double t) const {
  std::size_t i = count_ - 1;
  while (i > 0 && piece(i).begin > t) --i;
  return propagate(piece(i).state, piece(i).jerk, t - piece(i).begin);
}

}  // namespace swarm_planner
