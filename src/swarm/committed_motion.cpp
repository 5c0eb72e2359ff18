// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/committed_motion.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kTimeTolerance = CommittedMotion::kTimeTolerance;

void include(Box& box, const Box& other) {
  box.min = box.min.cwiseMin(other.min);
  box.max = box.max.cwiseMax(other.max);
}

}  // namespace

void CommittedMotion::assign(const Trajectory& plan, const StopManoeuvre& stop) {
  epoch_ = plan.epoch;
  dt_ = plan.dt;
  pieces_ = 0;
  if (plan.holds_acceleration) {
    // Each piece begins with the acceleration that it holds.
    for (std::size_t k = 0; k < kHorizon; ++k) {
      const KinematicState& x = plan.knots[k];
      const std::array<KinematicState, 2> ends{KinematicState{x.p, x.v, plan.knots[k + 1].a}, plan.knots[k + 1]};
      appendPieces(ends.data(), 1);
    }
  } else {
    appendPieces(plan.knots.data(), kHorizon);
  }
  appendPieces(stop.knots.data(), stop.stages);
  finish();
}

void CommittedMotion::assignStop(double epoch, const StopManoeuvre& stop) {
  epoch_ = epoch;
  dt_ = stop.dt;
  pieces_ = 0;
  appendPieces(stop.knots.data(), stop.stages);
  finish();
}

void CommittedMotion::assignRest(double epoch, const Vector3& position) {
  epoch_ = epoch;
  dt_ = 1.0;
  pieces_ = 0;
  points_[0] = position;
  finish();
}

int CommittedMotion::endedPieces(double t) const {
  const double elapsed = t - epoch_;
  return elapsed >= duration() ? pieces_ : std::max(static_cast<int>((elapsed + kTimeTolerance) / dt_), 0);
}

void CommittedMotion::assignPoints(double epoch, double dt, int pieces, const Vector3* points) {
  epoch_ = epoch;
  dt_ = dt;
  pieces_ = pieces;
  std::copy(points, points + 3 * static_cast<std::size_t>(pieces) + 1, points_.begin());
  finish();
}

void CommittedMotion::dropPieces(int count) {
  const int dropped = std::min(std::max(count, 0), pieces_);
  std::copy(&points_[3 * static_cast<std::size_t>(dropped)], &points_[3 * static_cast<std::size_t>(pieces_)] + 1,
            points_.begin());
  epoch_ += dropped * dt_;
  pieces_ -= dropped;
  finish();
}

void CommittedMotion::moveTo(double t) {
  if (t >= epoch_ + duration()) {
    assignRest(t, Vector3(restingPlace()));
  } else {
    dropPieces(endedPieces(t));
  }
}

void CommittedMotion::appendPieces(const KinematicState* knots, int count) {
  for (int k = 0; k < count; ++k) {
    const SegmentPoints points = segmentPoints(knots[k], knots[k + 1], dt_);
    std::copy(points.begin(), points.end(), &points_[3 * static_cast<std::size_t>(pieces_)]);
    ++pieces_;
  }
}

void CommittedMotion::finish() {
  const auto count = static_cast<std::size_t>(pieces_);
  // Sums keep what is not finite; comparisons would lose it.
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i <= 3 * count; ++i) sum += points_[i];
  finite_ = sum.allFinite() && std::isfinite(epoch_) && std::isfinite(dt_) && dt_ > 0.0;

  box_ = Box();
  group_boxes_.fill(Box());
  for (std::size_t k = 0; k <= count; ++k) {
    Box& box = piece_boxes_[k];
    box = Box();
    for (std::size_t i = 0; i < (k < count ? 4U : 1U); ++i) box.include(points_[3 * k + i]);
    if (k < count) include(group_boxes_[k / kGroup], box);
  }
  box_ = piece_boxes_[count];
  for (std::size_t g = 0; g * kGroup < count; ++g) include(box_, group_boxes_[g]);
}

Vector3 CommittedMotion::jerk(int k) const {
  if (k >= pieces_) return Vector3::Zero();
  const BernsteinPoints<4> p = piece(k);
  return 6.0 / (dt_ * dt_ * dt_) * (p[3] - p[0] + 3.0 * (p[1] - p[2]));
}

KinematicState CommittedMotion::after(double elapsed) const {
  if (pieces_ == 0 || elapsed >= duration()) return {restingPlace(), Vector3::Zero(), Vector3::Zero()};
  // Compared before the conversion to an integer: a time far from the epoch would overflow it.
  const double scaled = elapsed / dt_;
  const int k = scaled > 0.0 ? std::min(static_cast<int>(scaled), pieces_ - 1) : 0;
  const BernsteinPoints<4> p = piece(k);
  const double s = scaled - k;
  const Vector3 linear = 3.0 * (p[1] - p[0]);
  const Vector3 square = 3.0 * (p[0] - 2.0 * p[1] + p[2]);
  const Vector3 cube = p[3] - p[0] + 3.0 * (p[1] - p[2]);
  KinematicState x;
  x.p = p[0] + s * (linear + s * (square + s * cube));
  x.v = (linear + s * (2.0 * square + 3.0 * s * cube)) / dt_;
  x.a = (2.0 * square + 6.0 * s * cube) / (dt_ * dt_);
  return x;
}

Box CommittedMotion::boxOver(double begin, double end) const {
  const double first_time = (begin + kTimeTolerance) / dt_;
  if (first_time >= pieces_) return piece_boxes_[static_cast<std::size_t>(pieces_)];
  const double last_time = std::min((end - kTimeTolerance) / dt_, pieces_ - 1.0);
  const auto first = static_cast<std::size_t>(std::max(first_time, 0.0));
  const auto last = std::max(first, static_cast<std::size_t>(std::max(last_time, 0.0)));
  Box box;
  if (last - first < static_cast<std::size_t>(kGroup)) {
    for (std::size_t k = first; k <= last; ++k) include(box, piece_boxes_[k]);
  } else {
    for (std::size_t g = first / kGroup; g <= last / kGroup; ++g) include(box, group_boxes_[g]);
  }
  return box;
}

}  // namespace swarm_planner
