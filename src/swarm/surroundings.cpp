// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarm_planner {
namespace {

constexpr int kStopReach = 1;  // stages at full speed that a stop is as long as
constexpr double kForGood = std::numeric_limits<double>::infinity();

void include(Box& box, const Box& other) {
  box.min = box.min.cwiseMin(other.min);
  box.max = box.max.cwiseMax(other.max);
}

}  // namespace

Surroundings::Surroundings(const Parameters& parameters, std::size_t uav_count, std::size_t max_obstacles)
    : parameters_(parameters),
      obstacle_margin_(parameters.limits.as_paper ? 0.0 : parameters.limits.tracking_margin),
      pair_margin_(parameters.limits.as_paper ? 0.0 : parameters.limits.pair_margin),
      horizontal_(parameters.limits.pair_distance + pair_margin_),
      vertical_(parameters.limits.pair_distance_vertical + pair_margin_),
      motions_(uav_count),
      predictions_(uav_count),
      areas_(uav_count) {
  obstacles_.reserve(max_obstacles + uav_count);
  checked_obstacles_.reserve(max_obstacles + uav_count);
  asides_.reserve(uav_count);
  neighbours_.reserve(uav_count);
}

void Surroundings::setEpoch(double epoch) {
  epoch_ = epoch;
  asides_.clear();
}

void Surroundings::setObstacles(const std::vector<TrackedObstacle>& tracks, double now) {
  obstacles_.clear();
  checked_obstacles_.clear();
  for (const TrackedObstacle& track : tracks) {
    const double measured = parameters_.limits.latency_compensation ? track.stamp : now;
    addObstacle(track.shape, measured, inflationOf(track, parameters_.input));
  }
}

void Surroundings::addObstacle(const Superellipsoid& shape, double stamp, const TrackInflation& inflation) {
  const LimitParameters& limits = parameters_.limits;
  const double age = epoch_ - stamp;
  const double at_epoch = inflation.at(age);
  const DistanceGrowth growth{inflation.growth_rate * parameters_.time.sampling_time,
                              inflation.at(inflation.growth_time) - at_epoch};
  const Superellipsoid now = shape.movedBy(age);
  // (7) has no distance to keep but what is in the radii.
  obstacles_.push_back({limits.as_paper ? now.grownBy(limits.uav_radius) : now, at_epoch, growth});
  checked_obstacles_.push_back(predictObstacle(shape, stamp, inflation, limits.uav_radius + limits.tracking_error));
}

void Surroundings::setUnknown(std::size_t uav) {
  motions_[uav] = Motions();
  areas_[uav] = Box();
}

void Surroundings::setMotions(std::size_t uav, const CommittedMotion& newest, const CommittedMotion* older) {
  motions_[uav] = Motions();
  replaceMotions(uav, newest, older);
  areas_[uav] = motions_[uav].box;
}

void Surroundings::replaceMotions(std::size_t uav, const CommittedMotion& newest, const CommittedMotion* older) {
  predict(newest, epoch_, parameters_.time.sampling_time, predictions_[uav]);
  motions_[uav].newest = &newest;
  motions_[uav].older = older;
  updateBox(motions_[uav]);
}

void Surroundings::setDoubt(std::size_t uav, const MotionDoubt& doubt, const CommittedMotion* aside) {
  Motions& motions = motions_[uav];
  motions.doubt = doubt;
  if (aside != nullptr) {
    motions.aside = static_cast<int>(asides_.size());
    asides_.emplace_back();
    asides_.back().motion = aside;
    predict(*aside, epoch_, parameters_.time.sampling_time, asides_.back().prediction);
  }
  updateBox(motions);
  include(areas_[uav], motions.box);
}

void Surroundings::updateBox(Motions& motions) const {
  motions.box = motions.newest->box();
  if (motions.older != nullptr) include(motions.box, motions.older->box());
  if (motions.aside >= 0) include(motions.box, asides_[static_cast<std::size_t>(motions.aside)].motion->box());
  const Vector3 reach = Vector3::Constant(motions.doubt.limit);
  motions.box.min -= reach;
  motions.box.max += reach;
}

void Surroundings::setPlanning(std::size_t uav, const KinematicState& start) { include(areas_[uav], reach(start)); }

void Surroundings::findNeighbours() {
  const Vector3 half = 0.5 * Vector3(horizontal_, horizontal_, vertical_);
  for (Box& area : areas_) {
    area.min -= half;
    area.max += half;
  }
  neighbours_.build(areas_);
}

bool Surroundings::isWithinArea(std::size_t uav, const CommittedMotion& motion) const {
  const Vector3 half = 0.5 * Vector3(horizontal_, horizontal_, vertical_);
  const Box& area = areas_[uav];
  return (motion.box().min.array() >= (area.min + half).array()).all() &&
         (motion.box().max.array() <= (area.max - half).array()).all();
}

double Surroundings::pairGauge(const Vector3& apart) const {
  return apart.cwiseQuotient(Vector3(horizontal_, horizontal_, vertical_)).norm();
}

double Surroundings::leastPairGauge(std::size_t first, std::size_t second, double limit) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (motions_[first].newest == nullptr || motions_[second].newest == nullptr) return kInfinity;
  const PredictedMotion &a = predictions_[first], &b = predictions_[second];
  if (!a.box.near(b.box, limit * std::max(horizontal_, vertical_))) return kInfinity;
  double least = kInfinity;
  for (std::size_t i = 0; i < a.points.size(); ++i) least = std::min(least, pairGauge(a.points[i] - b.points[i]));
  return least;
}

Box Surroundings::reach(const KinematicState& start) const {
  const double speed = std::max(parameters_.limits.max_speed, start.v.norm());
  // The stop goes on for some stages, ever slower.
  const Vector3 extent = Vector3::Constant(speed * (kHorizon + kStopReach) * parameters_.time.sampling_time);
  return {start.p - extent, start.p + extent};
}

UavPair Surroundings::pairDistances() const { return {0, 1, horizontal_, vertical_, parameters_.limits.pair_margin}; }

void Surroundings::collect(std::size_t uav, UavProblem& problem) const {
  problem.bodies.clear();
  if (!parameters_.limits.avoidance) return;
  const Box box = reach(problem.start);
  collectObstacles(box, problem);
  collectUavs(uav, box, problem);
}

void Surroundings::collectObstacles(const Box& reach, UavProblem& problem) const {
  const double level = std::exp(parameters_.cost.epsilon_s);
  const bool as_paper = parameters_.limits.as_paper;
  const double distance = as_paper ? 0.0 : parameters_.limits.uav_radius + obstacle_margin_;
  // The robustness function reaches as far as S = r_b, at most sqrt(r_b) radii.
  const double halo = std::sqrt(parameters_.cost.robustness_outer) - 1.0;
  for (const PredictedTrack& track : obstacles_) {
    const Superellipsoid& obstacle = track.shape;
    MovingBody body = MovingBody::fromObstacle(obstacle, problem.dt, level, distance + track.inflation, track.growth);
    if (!body.box().near(reach, halo * obstacle.halfExtents().maxCoeff())) continue;
    if (problem.is_guided) body.setPrecise();
    if (as_paper) body.setLogarithmic();
    body.relieve(problem.start.p - obstacle.center(), obstacle_margin_);
    body.setIdentity(2 * static_cast<std::uint32_t>(obstacle.id()));
    problem.bodies.push_back(body);
  }
}

void Surroundings::collectUavs(std::size_t uav, const Box& reach, UavProblem& problem) const {
  const auto count = static_cast<std::uint32_t>(motions_.size());
  for (const std::uint32_t other : neighbours_.of(uav)) {
    const Motions& motions = motions_[other];
    if (motions.newest == nullptr) continue;
    if (!motions.box.near(reach, std::max(horizontal_, vertical_))) continue;
    addUav(uav, other, predictions_[other], 2 * other + 1, reach, problem);
    if (motions.aside < 0) continue;
    const PredictedMotion& aside = asides_[static_cast<std::size_t>(motions.aside)].prediction;
    addUav(uav, other, aside, 2 * (other + count) + 1, reach, problem);
  }
}

void Surroundings::addUav(std::size_t uav, std::uint32_t other, const PredictedMotion& motion, std::uint32_t identity,
                          const Box& reach, UavProblem& problem) const {
  const MotionDoubt& doubt = motions_[other].doubt;
  const double now = doubt.at(epoch_);
  const double horizontal = horizontal_ + now;
  const double vertical = vertical_ + now;
  if (!motion.box.near(reach, std::max(horizontal, vertical) + doubt.limit)) return;
  const DistanceGrowth growth{doubt.rate * parameters_.time.sampling_time, doubt.limit - now};
  MovingBody body = MovingBody::fromUav(motion, horizontal, vertical,
                                        uav < other ? Vector3(Vector3::UnitX()) : Vector3(-Vector3::UnitX()), growth);
  body.relieve(problem.start.p - motion.point(0, 0), pair_margin_ + now);
  body.setIdentity(identity);
  problem.bodies.push_back(body);
}

void Surroundings::collect(std::size_t uav, CheckSurroundings& surroundings) const {
  surroundings.clear();
  if (!parameters_.limits.avoidance) return;
  surroundings.obstacles.assign(checked_obstacles_.begin(), checked_obstacles_.end());
  for (const std::uint32_t other : neighbours_.of(uav)) {
    const Motions& motions = motions_[other];
    if (motions.newest == nullptr || !motions.box.near(areas_[uav], 0.5 * std::max(horizontal_, vertical_))) continue;
    surroundings.uavs.push_back({motions.newest, kForGood, motions.doubt});
    if (motions.aside >= 0) {
      const Aside& aside = asides_[static_cast<std::size_t>(motions.aside)];
      surroundings.uavs.push_back({aside.motion, kForGood, motions.doubt});
    }
    if (motions.older == nullptr || parameters_.input.lost_setpoints == 0) continue;
    // The cycle after the newest motion's sends the next one, which is not lost too.
    surroundings.uavs.push_back(
        {motions.older, motions.newest->epoch() + parameters_.time.cycle_period, motions.doubt});
  }
}

}  // namespace swarm_planner
