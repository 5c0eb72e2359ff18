// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/plan_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "swarm_planner/swarm/clearance_proof.hpp"
#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/map_check.hpp"
#include "swarm_planner/swarm/pair_check.hpp"

namespace swarm_planner {
namespace {

bool isFinite(const KinematicState& x) { return x.p.allFinite() && x.v.allFinite() && x.a.allFinite(); }

bool isFinite(const Trajectory& plan) {
  return std::isfinite(plan.epoch) && std::isfinite(plan.dt) && plan.dt > 0.0 &&
         std::all_of(plan.knots.begin(), plan.knots.end(), [](const KinematicState& x) { return isFinite(x); }) &&
         std::all_of(plan.jerks.begin(), plan.jerks.end(), [](const Vector3& j) { return j.allFinite(); });
}

bool isFinite(const PredictedObstacle& obstacle) {
  return std::isfinite(obstacle.stamp) && std::isfinite(obstacle.least_distance) && obstacle.least_distance >= 0.0 &&
         std::isfinite(obstacle.growth_rate) && obstacle.growth_rate >= 0.0 && obstacle.growth_time >= 0.0 &&
         !std::isnan(obstacle.valid_until);
}

bool areClose(const KinematicState& x, const KinematicState& y) {
  const Vector3 difference = (x.p - y.p).cwiseAbs().cwiseMax((x.v - y.v).cwiseAbs()).cwiseMax((x.a - y.a).cwiseAbs());
  return difference.maxCoeff() <= kKnotTolerance;
}

CheckReason reasonOf(FlightBound bound) {
  switch (bound) {
    case FlightBound::kNone:
      return CheckReason::kAccepted;
    case FlightBound::kSpeed:
      return CheckReason::kSpeed;
    case FlightBound::kAcceleration:
      return CheckReason::kAcceleration;
    case FlightBound::kJerk:
      return CheckReason::kJerk;
    case FlightBound::kThrust:
      return CheckReason::kThrust;
  }
  return CheckReason::kThrust;
}

CheckVerdict checkDynamics(const Trajectory& plan, const KinematicState& start, const FlightBounds& bounds) {
  if (!areClose(plan.knots[0], start)) return {CheckReason::kDiscontinuous, 0.0};
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const double time = static_cast<double>(k) * plan.dt;
    const EnvelopeBreach breach = findBreach(bounds, plan.knots[k], plan.jerks[k], plan.dt);
    if (!areClose(propagate(plan.knots[k], plan.jerks[k], plan.dt), plan.knots[k + 1])) {
      return {CheckReason::kDiscontinuous, time + plan.dt};
    }
    if (breach.bound != FlightBound::kNone) return {reasonOf(breach.bound), time + breach.time};
  }
  return {};
}

bool contains(const Workspace& workspace, const Box& box) {
  return (box.min.array() >= workspace.min.array() - kDistanceTolerance).all() &&
         (box.max.array() <= workspace.max.array() + kDistanceTolerance).all();
}

/// Halved until the hull of the control points, or a point of the curve, decides.
ClearanceFinding staysInside(const Workspace& workspace, const BernsteinPoints<4>& points, double from, double to,
                             int depth) {
  constexpr int kMaxDepth = 16;
  Box hull;
  for (const Vector3& point : points) hull.include(point);
  if (contains(workspace, hull)) return {};
  const double middle = 0.5 * (from + to);
  const Vector3 point = curveMiddle(points);
  if (!contains(workspace, {points[0], points[0]})) return {false, false, from};
  if (!contains(workspace, {point, point})) return {false, false, middle};
  if (!contains(workspace, {points[3], points[3]})) return {false, false, to};
  if (depth == kMaxDepth) return {false, true, middle};
  BernsteinPoints<4> left;
  BernsteinPoints<4> right;
  halve(points, left, right);
  const ClearanceFinding first = staysInside(workspace, left, from, middle, depth + 1);
  return first.clear ? staysInside(workspace, right, middle, to, depth + 1) : first;
}

CheckVerdict checkWorkspace(const CommittedMotion& motion, const CheckLimits& limits) {
  Workspace workspace = limits.bounds.workspace;
  if (contains(workspace, motion.box())) return {};
  const Vector3 slack = Vector3::Constant(limits.workspace_slack);
  workspace.min = workspace.min.cwiseMin(motion.start().cwiseMax(workspace.min - slack));
  workspace.max = workspace.max.cwiseMax(motion.start().cwiseMin(workspace.max + slack));
  for (int k = 0; k < motion.pieces(); ++k) {
    if (contains(workspace, motion.pieceBox(k))) continue;
    const double from = k * motion.dt();
    const ClearanceFinding finding = staysInside(workspace, motion.piece(k), from, from + motion.dt(), 0);
    if (!finding.clear) return {CheckReason::kWorkspace, finding.time, -1, finding.undecided};
  }
  if (!contains(workspace, motion.pieceBox(motion.pieces()))) return {CheckReason::kWorkspace, motion.duration()};
  return {};
}

/// One motion against one obstacle. Times are in seconds after the motion's epoch.
class ObstacleCheck {
 public:
  ObstacleCheck(const CommittedMotion& motion, const PredictedObstacle& obstacle, const CheckLimits& limits)
      : motion_(motion),
        body_(*obstacle.body),
        growth_rate_(obstacle.growth_rate),
        // A stamp after the epoch counts as the epoch: what grows later is never less than demanded.
        growth_end_(std::max(obstacle.growth_time - std::max(motion.epoch() - obstacle.stamp, 0.0), 0.0)),
        center_(body_.center() + (motion.epoch() - obstacle.stamp) * body_.velocity()),
        distance_(obstacle.least_distance +
                  growth_rate_ * std::clamp(motion.epoch() - obstacle.stamp, 0.0, obstacle.growth_time)),
        end_(std::min(motion.duration() + limits.look_ahead, obstacle.valid_until - motion.epoch())),
        proof_(body_) {}

  CheckVerdict run(const Vector3& committed) {
    if (end_ < 0.0 || isFar(motion_.box(), 0.0, end_)) return {};
    if (!relieve(committed)) return {CheckReason::kObstacle, 0.0};
    for (int first = 0; first < motion_.pieces(); first += CommittedMotion::kGroup) {
      const int last = std::min(first + CommittedMotion::kGroup, motion_.pieces());
      const double from = first * motion_.dt();
      const double to = last * motion_.dt();
      if (from > end_) return {};
      if (isFar(motion_.groupBox(first / CommittedMotion::kGroup), from, to)) continue;
      for (int k = first; k < last; ++k) {
        const CheckVerdict verdict = checkPiece(k, k * motion_.dt(), (k + 1) * motion_.dt());
        if (!verdict.accepted()) return verdict;
      }
    }
    return checkPiece(motion_.pieces(), motion_.duration(), end_);
  }

 private:
  double distanceAt(double time) const { return distance_ + growth_rate_ * std::min(time, growth_end_); }
  Vector3 centerAt(double time) const { return center_ + time * body_.velocity(); }

  /// Whether a box is certainly clear of the body as it sweeps from one time to another.
  bool isFar(const Box& box, double from, double to) const {
    const Vector3 a = centerAt(from);
    const Vector3 b = centerAt(to);
    const Vector3 above = box.min - a.cwiseMax(b);
    const Vector3 below = a.cwiseMin(b) - box.max;
    const Vector3 gap = (above.cwiseMax(below) - body_.halfExtents()).cwiseMax(0.0);
    const double distance = distanceAt(to);
    return gap.squaredNorm() > distance * distance;
  }

  /// Reduces what is demanded to what the committed motion has. False if the start has less.
  bool relieve(const Vector3& committed) {
    distance_ = std::max(distance_ - kDistanceTolerance, 0.0);
    if (distanceFrom(motion_.start()) >= distance_) return true;
    distance_ = std::min(distance_, std::max(distanceFrom(committed) - kDistanceTolerance, 0.0));
    return distanceFrom(motion_.start()) >= distance_;
  }

  /// Of a point at the epoch from the body; no more than is demanded has to be known.
  double distanceFrom(const Vector3& point) const {
    const Vector3 relative = point - center_;
    const Vector3 gap = (relative.cwiseAbs() - body_.halfExtents()).cwiseMax(0.0);
    if (gap.squaredNorm() > distance_ * distance_) return gap.norm();
    const double bound = distanceBound(body_, relative);
    return bound > distance_ ? bound : body_.signedDistance(body_.center() + relative);
  }

  CheckVerdict checkPiece(int k, double from, double to) {
    if (to < from || from > end_ || isFar(motion_.pieceBox(k), from, to)) return {};
    BernsteinPoints<4> relative = motion_.piece(k);
    const Vector3 begin = centerAt(from);
    const Vector3 step = (to - from) / 3.0 * body_.velocity();
    for (int i = 0; i < 4; ++i) relative[static_cast<std::size_t>(i)] -= begin + i * step;
    // The proof takes a demand that is linear over the piece. Where growth ends within it the demand lies above its
    // chord: there it is that of the end all along.
    const bool grows_on = growth_end_ >= to || growth_end_ <= from;
    const ClearanceFinding finding = proof_.prove(relative, from, to, distanceAt(grows_on ? from : to), distanceAt(to));
    if (finding.clear) return {};
    const CheckReason reason = k < motion_.pieces() ? CheckReason::kObstacle : CheckReason::kRestingPlace;
    return {reason, finding.time, -1, finding.undecided};
  }

  const CommittedMotion& motion_;
  const Superellipsoid& body_;
  double growth_rate_;
  double growth_end_;  ///< [s]
  Vector3 center_;     ///< at the epoch
  double distance_;    ///< demanded at the epoch [m]
  double end_;
  ObstacleProof proof_;
};

CheckVerdict withBody(CheckVerdict verdict, std::size_t body) {
  verdict.body = static_cast<int>(body);
  return verdict;
}

}  // namespace

const char* checkReasonText(CheckReason reason) {
  switch (reason) {
    case CheckReason::kAccepted:
      return "accepted";
    case CheckReason::kNotFinite:
      return "a number is not finite";
    case CheckReason::kDiscontinuous:
      return "does not follow from its start and jerks";
    case CheckReason::kSpeed:
      return "exceeds the speed limit";
    case CheckReason::kAcceleration:
      return "exceeds the acceleration limit";
    case CheckReason::kJerk:
      return "exceeds the jerk limit";
    case CheckReason::kThrust:
      return "exceeds the thrust limits";
    case CheckReason::kNoStop:
      return "cannot stop at its end within the limits";
    case CheckReason::kWorkspace:
      return "leaves the workspace";
    case CheckReason::kObstacle:
      return "too close to an obstacle";
    case CheckReason::kUav:
      return "too close to another UAV";
    case CheckReason::kRestingPlace:
      return "an obstacle comes to its resting place";
    case CheckReason::kOutOfArea:
      return "goes farther than others expect";
    case CheckReason::kMap:
      return "too close to what the map has as occupied";
  }
  return "unknown";
}

PredictedObstacle predictObstacle(const Superellipsoid& shape, double stamp, const TrackInflation& inflation,
                                  double least) {
  PredictedObstacle obstacle;
  obstacle.body = &shape;
  obstacle.stamp = stamp;
  obstacle.least_distance = least + inflation.at_stamp;
  obstacle.growth_rate = inflation.growth_rate;
  obstacle.growth_time = inflation.growth_time;
  return obstacle;
}

CheckVerdict checkClearance(const CommittedMotion& motion, const Vector3& committed, const CheckLimits& limits,
                            const CheckSurroundings& surroundings) {
  if (!motion.isFinite()) return {CheckReason::kNotFinite};
  const CheckVerdict workspace = checkWorkspace(motion, limits);
  if (!workspace.accepted()) return workspace;
  if (surroundings.map != nullptr) {
    const ClearanceFinding finding = MapProof(*surroundings.map, surroundings.map_distance, committed).prove(motion);
    if (!finding.clear) return {CheckReason::kMap, finding.time, -1, finding.undecided};
  }
  for (std::size_t i = 0; i < surroundings.obstacles.size(); ++i) {
    const PredictedObstacle& obstacle = surroundings.obstacles[i];
    if (!isFinite(obstacle)) return withBody({CheckReason::kNotFinite}, i);
    const CheckVerdict verdict = ObstacleCheck(motion, obstacle, limits).run(committed);
    if (!verdict.accepted()) return withBody(verdict, i);
  }
  for (std::size_t i = 0; i < surroundings.uavs.size(); ++i) {
    const OtherMotion& other = surroundings.uavs[i];
    if (!other.motion->isFinite()) return withBody({CheckReason::kNotFinite}, i);
    const CheckVerdict verdict = checkPair(motion, other, committed, limits);
    if (!verdict.accepted()) return withBody(verdict, i);
  }
  return {};
}

CheckVerdict checkPlan(const Trajectory& plan, const KinematicState& start, const Vector3& committed,
                       const CheckLimits& limits, const CheckSurroundings& surroundings, CommittedMotion& motion) {
  if (!isFinite(plan) || !isFinite(start)) return {CheckReason::kNotFinite};
  const FlightBounds bounds = relieveBounds(limits.bounds, start, limits.bound_slack);
  const CheckVerdict dynamics = checkDynamics(plan, start, bounds);
  if (dynamics.reason == CheckReason::kDiscontinuous) return dynamics;
  StopManoeuvre stop;
  planStop(plan.knots.back(), plan.dt, bounds, stop);
  motion.assign(plan, stop);
  if (!dynamics.accepted()) return dynamics;
  if (!stop.within_bounds) return {CheckReason::kNoStop, plan.duration()};
  return checkClearance(motion, committed, limits, surroundings);
}

}  // namespace swarm_planner
