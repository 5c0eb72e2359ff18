// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/guided_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swarm_planner {
namespace {

constexpr std::size_t kMostPoints = GuidePath::kMostPoints + FollowedPath::kMostPoints;
constexpr double kFootWindow = 5.0;     // about the last foot [m]
constexpr double kBrakingStages = 5.0;  // from max_speed to rest
constexpr double kSharpest = 1e-4;
constexpr double kHeldUp = 0.5;     // of the way asked for, that a plan lacks at its end if it does not get on
constexpr double kStanding = 0.25;  // of the pair distance, within which a plan leads nowhere
constexpr double kAtEnd = 0.5;      // of a guide that ends beside its reference's end [m]
constexpr int kRetries = 4;         // cycles between two fresh starts of a UAV that does not get on
constexpr double kRegain = 1.5;     // by which the lead of its targets grows in a cycle in which it does
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

GuidedFlight::GuidedFlight() { path_.reserve(kMostPoints); }

void GuidedFlight::setFollowed(const MovingTarget& target) {
  const std::vector<Vector3>& points = target.path.points();
  const bool is_same = followed_ == &target && points_ == points.size() &&
                       (points.empty() || (first_ == points.front() && last_ == points.back()));
  if (is_same) return;
  followed_ = &target;
  points_ = points.size();
  if (!points.empty()) {
    first_ = points.front();
    last_ = points.back();
  }
  ++version_;
  active_ = needs_fresh_start_ = false;
  has_no_way_ = false;
}

void GuidedFlight::forget() {
  followed_ = nullptr;
  active_ = needs_fresh_start_ = false;
  has_no_way_ = false;
}

Reason GuidedFlight::reasonToStand() const {
  if (has_no_way_) return Reason::kNoWayRound;
  const bool is_at_end = active_ && !rejoins_ && to_rejoin_ - progress_ < kAtEnd;
  return is_at_end ? Reason::kEndNotClear : Reason::kNone;
}

void GuidedFlight::take(const GuideAnswer& answer, const MovingTarget& target) {
  if (answer.version != version_ || followed_ != &target) return;
  has_no_way_ = answer.state == GuideState::kNoWay;
  if (answer.state != GuideState::kGuided) {
    if (active_) needs_fresh_start_ = false;
    active_ = false;
    return;
  }
  if (active_ && answer.number == number_) return;
  const bool is_other_way = !active_ || answer.course != course_;
  std::array<Vector3, kMostPoints> points;
  std::size_t count = answer.path.count;
  std::copy(answer.path.points.begin(), answer.path.points.begin() + static_cast<std::ptrdiff_t>(count),
            points.begin());
  if (answer.rejoins) {
    target.path.forEachPointAfter(answer.rejoin, [&](const Vector3& point, double) {
      if (count == kMostPoints) return false;
      points[count++] = point;
      return true;
    });
  }
  path_.assign(points.data(), count);
  to_rejoin_ = answer.path.length();
  branch_ = answer.branch;
  rejoin_ = answer.rejoin;
  rejoins_ = answer.rejoins;
  number_ = answer.number;
  progress_ = 0.0;
  course_ = answer.course;
  active_ = is_new_ = true;
  if (!is_other_way) return;
  needs_fresh_start_ = true;
  held_up_ = 0;
  lead_ = kInfinity;
}

double GuidedFlight::wayOf(double arc_length) const {
  if (!rejoins_) return to_rejoin_;
  if (arc_length >= rejoin_) return to_rejoin_ + arc_length - rejoin_;
  const double share = rejoin_ > branch_ ? (arc_length - branch_) / (rejoin_ - branch_) : 1.0;
  return std::max(share, 0.0) * to_rejoin_;
}

void GuidedFlight::limitCorners(const UavProblem& problem) {
  const LimitParameters& limits = problem.parameters->limits;
  const double cut = limits.uav_radius + limits.tracking_margin;
  braking_ = problem.bounds.max_speed / (kBrakingStages * problem.dt);
  corner_count_ = 0;
  const std::vector<Vector3>& points = path_.points();
  double way = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vector3 before = points[i] - points[i - 1];
    const Vector3 after = points[i + 1] - points[i];
    way += before.norm();
    // An arc that leaves the corner by `cut` has the radius cut / (1 / cos(turn / 2) - 1).
    const double cosine = before.normalized().dot(after.normalized());
    const double half = std::sqrt(std::max(0.5 * (1.0 + cosine), kSharpest));
    const double radius = cut * half / std::max(1.0 - half, kSharpest);
    const double speed = std::sqrt(braking_ * radius);
    if (speed < problem.bounds.max_speed) corners_[corner_count_++] = {way, speed};
  }
}

double GuidedFlight::speedAt(double way, double max_speed) const {
  double speed = max_speed;
  for (std::size_t i = 0; i < corner_count_; ++i) {
    const Corner& corner = corners_[i];
    if (corner.way < way) continue;
    speed = std::min(speed, std::sqrt(corner.speed * corner.speed + 2.0 * braking_ * (corner.way - way)));
  }
  return speed;
}

void GuidedFlight::pose(const MovingTarget& target, double& progress, UavProblem& problem) {
  const PathPoint foot = path_.nearest(problem.start.p, progress_, is_new_ ? kInfinity : kFootWindow);
  if (is_new_) limitCorners(problem);
  is_new_ = false;
  progress_ = foot.arc_length;
  if (rejoins_ && progress_ > to_rejoin_) progress = rejoin_ + progress_ - to_rejoin_;
  problem.path = &path_;
  problem.progress = progress_;
  const double max_speed = problem.bounds.max_speed;
  double speed = std::clamp(problem.start.v.dot(foot.tangent), 0.0, max_speed);
  double way = progress_;
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    const double wanted = wayOf(target.at(problem.epoch + static_cast<double>(k) * problem.dt).arc_length);
    const double before = way;
    if (k > 0) {
      speed = std::min(speed + braking_ * problem.dt, speedAt(way, max_speed));
      way = std::max(std::min({wanted, way + speed * problem.dt, progress_ + lead_}), way);
    }
    const PathPoint point = path_.at(way);
    TargetState& state = problem.targets[k];
    state.p = point.position;
    state.arc_length = way = point.arc_length;
    state.v = (way - before) / problem.dt * point.tangent;
  }
  problem.targets[0].v = problem.targets[1].v;
}

void GuidedFlight::notePlan(const Vector3& end, const UavProblem& problem) {
  needs_fresh_start_ = false;
  if (!active_ && !problem.corridor.active) return;
  const double asked = problem.targets[kHorizon].arc_length - problem.progress;
  const double lacking = (problem.targets[kHorizon].p - end).norm();
  const LimitParameters& limits = problem.parameters->limits;
  // A target behind a wall may be near: as long as much is asked for, the plan has to lead somewhere, too.
  const bool stands =
      asked >= limits.pair_distance && (end - problem.start.p).norm() < kStanding * limits.pair_distance;
  const bool gets_on = !stands && lacking < std::max(kHeldUp * asked, kHeldUp * limits.pair_distance);
  held_up_ = gets_on ? 0 : held_up_ + 1;
  needs_fresh_start_ = held_up_ % kRetries == 1;
  if (gets_on) {
    lead_ *= kRegain;
  } else if (held_up_ % kRetries == 0) {
    lead_ = std::max(0.5 * asked, limits.pair_distance);
  }
}

}  // namespace swarm_planner
