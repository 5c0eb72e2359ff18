// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/guided_flight.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace swarm_planner {
namespace {

constexpr std::size_t kMostPoints = GuidePath::kMostPoints + FollowedPath::kMostPoints;
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
  active_ = false;
  has_no_way_ = false;
}

void GuidedFlight::take(const GuideAnswer& answer, const MovingTarget& target) {
  if (answer.version != version_ || followed_ != &target) return;
  has_no_way_ = answer.state == GuideState::kNoWay;
  if (answer.state != GuideState::kGuided) {
    active_ = false;
    return;
  }
  if (active_ && answer.number == number_) return;
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
  active_ = is_new_ = true;
}

double GuidedFlight::wayOf(double arc_length) const {
  if (!rejoins_) return to_rejoin_;
  if (arc_length >= rejoin_) return to_rejoin_ + arc_length - rejoin_;
  const double share = rejoin_ > branch_ ? (arc_length - branch_) / (rejoin_ - branch_) : 1.0;
  return std::max(share, 0.0) * to_rejoin_;
}

void GuidedFlight::pose(const MovingTarget& target, double& progress, UavProblem& problem) {
  const double window = is_new_ ? kInfinity : 5.0;
  progress_ = path_.nearest(problem.start.p, progress_, window).arc_length;
  is_new_ = false;
  if (rejoins_ && progress_ > to_rejoin_) progress = rejoin_ + progress_ - to_rejoin_;
  problem.path = &path_;
  problem.progress = progress_;
  const double speed = problem.bounds.max_speed;
  double way = progress_;
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    const double elapsed = static_cast<double>(k) * problem.dt;
    const double wanted = wayOf(target.at(problem.epoch + elapsed).arc_length);
    const double before = way;
    way = std::clamp(wanted, progress_, progress_ + speed * elapsed);
    const PathPoint point = path_.at(way);
    TargetState& state = problem.targets[k];
    state.p = point.position;
    state.arc_length = point.arc_length;
    state.v.setZero();
    // Over the stage before: the first stage is where the UAV is anyway.
    if (k > 0 && point.arc_length > before) state.v = (point.arc_length - before) / problem.dt * point.tangent;
    way = point.arc_length;
  }
}

}  // namespace swarm_planner
