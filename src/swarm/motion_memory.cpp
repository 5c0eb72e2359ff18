// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/motion_memory.hpp"

#include <algorithm>

namespace swarm_planner {

void MotionMemory::clear() {
  count_ = 0;
  on_older_ = false;
  path_.clear();
}

std::optional<KinematicState> MotionMemory::expectedAt(double t) const {
  if (count_ == 0) return {};
  if (t >= flown().epoch()) return flown().at(t);
  if (path_.covers(t)) return path_.at(t);
  return {};
}

void MotionMemory::compare(double stamp, const Vector3& p, double difference) {
  if (count_ < 2 || stamp <= newest().epoch()) return;
  const double from_newest = (p - newest().at(stamp).p).norm();
  const double from_older = (p - older()->at(stamp).p).norm();
  on_older_ = from_older + difference < from_newest;
}

void MotionMemory::begin(const CommittedMotion& past, const CommittedMotion& motion) {
  clear();
  path_.append(past, motion.epoch());
  commit(motion);
}

void MotionMemory::restore(const CommittedMotion& newest, const CommittedMotion* older) {
  clear();
  if (older != nullptr) commit(*older);
  commit(newest);
}

void MotionMemory::keepNearest(double stamp, const Vector3& p) {
  compare(stamp, p, 0.0);
  forgetLost();
}

void MotionMemory::commit(const CommittedMotion& motion) {
  if (count_ > 0) path_.append(flown(), motion.epoch());
  push(motion);
}

void MotionMemory::startAnew(const CommittedMotion& motion) {
  path_.clear();
  push(motion);
}

void MotionMemory::push(const CommittedMotion& motion) {
  if (count_ > 0 && !on_older_) newest_ = 1 - newest_;
  count_ = std::min(count_ + 1, 2);
  motions_[newest_] = motion;
  newest_since_ = motion.epoch();
  on_older_ = false;
}

void MotionMemory::forgetLost() {
  if (!on_older_) return;
  newest_ = 1 - newest_;
  count_ = 1;
  on_older_ = false;
}

void MotionMemory::goOn(double epoch) {
  forgetLost();
  CommittedMotion& motion = motions_[newest_];
  if (epoch >= motion.epoch() + motion.duration()) {
    path_.append(motion, epoch);
    motion.assignRest(epoch, Vector3(motion.restingPlace()));
    return;
  }
  const int ended = motion.endedPieces(epoch);
  if (ended <= 0) return;
  path_.append(motion, motion.epoch() + ended * motion.dt());
  motion.dropPieces(ended);
}

}  // namespace swarm_planner
