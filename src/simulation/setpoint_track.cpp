// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/setpoint_track.hpp"

#include <algorithm>
#include <cmath>

#include "swarm_planner/config/plausible.hpp"

namespace swarm_planner {
namespace {

constexpr double kMostAhead = 60.0;  // [s]
constexpr std::size_t kMostWaiting = 64;
constexpr double kMinSpacing = 1e-4;  // [s]: the fifth power of it still divides well

bool isPlausible(const Vector3& x) { return isWithin(x, kMostSetpoint); }

MotionSetpoint atRest(const Vector3& p) {
  MotionSetpoint rest;
  rest.p = p;
  return rest;
}

/// When a trajectory takes over [s].
double begin(const SetpointTrajectory& trajectory) {
  return trajectory.epoch + trajectory.points.front().time_from_start;
}

/// The quintic with p, v, a of `from` at 0 and of `to` at `h` [s], evaluated `tau` [s] after `from`.
MotionSetpoint quinticHermite(const Setpoint& from, const Setpoint& to, double h, double tau) {
  // What is left to reach at the end after the motion with constant acceleration from `from`.
  const Vector3 dp = to.p - from.p - h * from.v - (0.5 * h * h) * from.a;
  const Vector3 dv = (to.v - from.v - h * from.a) * h;
  const Vector3 da = (to.a - from.a) * (h * h);
  const Vector3 c3 = 10.0 * dp - 4.0 * dv + 0.5 * da;
  const Vector3 c4 = -15.0 * dp + 7.0 * dv - da;
  const Vector3 c5 = 6.0 * dp - 3.0 * dv + 0.5 * da;
  const double s = tau / h;
  MotionSetpoint x;
  x.p = from.p + tau * from.v + (0.5 * tau * tau) * from.a + (s * s * s) * (c3 + s * (c4 + s * c5));
  x.v = from.v + tau * from.a + (s * s / h) * (3.0 * c3 + s * (4.0 * c4 + (5.0 * s) * c5));
  x.a = from.a + (s / (h * h)) * (6.0 * c3 + s * (12.0 * c4 + (20.0 * s) * c5));
  x.jerk = (6.0 * c3 + s * (24.0 * c4 + (60.0 * s) * c5)) / (h * h * h);
  return x;
}

}  // namespace

bool isFlyable(const SetpointTrajectory& trajectory) {
  if (trajectory.points.empty() || !std::isfinite(trajectory.epoch)) return false;
  double last = -kMinSpacing;
  for (const Setpoint& point : trajectory.points) {
    const double time = point.time_from_start;
    if (!(time >= 0.0 && time <= kMostSetpoint && time - last >= kMinSpacing)) return false;
    if (!isPlausible(point.p) || !isPlausible(point.v) || !isPlausible(point.a)) return false;
    if (!std::isfinite(point.yaw)) return false;
    last = time;
  }
  return true;
}

SetpointTrack::SetpointTrack(const Vector3& start) : rest_(start) {}

bool SetpointTrack::receive(const SetpointTrajectory& trajectory, double now) {
  if (!isFlyable(trajectory) || begin(trajectory) > now + kMostAhead) return false;
  const auto later = std::lower_bound(received_.begin(), received_.end(), begin(trajectory),
                                      [](const SetpointTrajectory& x, double t) { return begin(x) < t; });
  received_.erase(later, received_.end());
  if (received_.size() >= kMostWaiting) received_.pop_back();
  received_.push_back(trajectory);
  // Forget what a successor has taken over from long enough ago.
  const SetpointTrajectory* active = activeAt(now - kSetpointMemory);
  if (active != nullptr) received_.erase(received_.begin(), received_.begin() + (active - received_.data()));
  return true;
}

const SetpointTrajectory* SetpointTrack::activeAt(double t) const {
  for (auto it = received_.rbegin(); it != received_.rend(); ++it) {
    if (begin(*it) <= t) return &*it;
  }
  return nullptr;
}

MotionSetpoint SetpointTrack::at(double t) const {
  const SetpointTrajectory* active = activeAt(t);
  if (active == nullptr) return atRest(rest_);
  const std::vector<Setpoint>& points = active->points;
  const double since_epoch = t - active->epoch;
  if (points.size() == 1 || since_epoch >= points.back().time_from_start) return atRest(points.back().p);
  // From the second point on: rounding of large times may put `t` just before the first.
  const auto to = std::upper_bound(points.begin() + 1, points.end(), since_epoch,
                                   [](double time, const Setpoint& x) { return time < x.time_from_start; });
  const Setpoint& from = *(to - 1);
  return quinticHermite(from, *to, to->time_from_start - from.time_from_start, since_epoch - from.time_from_start);
}

void SetpointTrack::hold(const Vector3& position) {
  rest_ = position;
  received_.clear();
}

}  // namespace swarm_planner
