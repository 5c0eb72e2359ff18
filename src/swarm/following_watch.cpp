// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/following_watch.hpp"

#include <algorithm>
#include <optional>

namespace swarm_planner {
namespace {

constexpr double kLeastNoise = 0.05;  // tracking is not perfect [m]
constexpr double kOnMotion = 0.5;     // of what is allowed, with which it is taken to be on its motion

double noiseOf(const InputParameters& input) { return std::max(input.odometry_noise, kLeastNoise); }

/// How far a measurement is off a state, and to which side.
struct Deviation {
  double size = 0.0;  ///< over what is allowed for
  Vector3 direction = Vector3::Zero();
};

Deviation deviationFrom(const KinematicState& expected, const UavMeasurement& measurement,
                        const InputParameters& input) {
  const Vector3 dp = measurement.p - expected.p;
  // A source that always says zero does not know the velocity.
  const bool is_known = !measurement.v.isZero(0.0);
  const Vector3 dv = is_known ? Vector3(measurement.v - expected.v) : Vector3(Vector3::Zero());
  return {FollowingWatch::excess(dp, dv, input), dp + input.tracking_time * dv};
}

/// From the nearest of the motions that it may be flying; empty if none reaches back so far.
std::optional<Deviation> leastDeviation(const UavMeasurement& measurement, const MotionMemory& motions,
                                        const InputParameters& input) {
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  if (!expected) return {};
  Deviation least = deviationFrom(*expected, measurement, input);
  for (const CommittedMotion* motion : {motions.older(), &motions.newest()}) {
    if (motion == nullptr || measurement.stamp < motion->epoch()) continue;
    const Deviation deviation = deviationFrom(motion->at(measurement.stamp), measurement, input);
    if (deviation.size < least.size) least = deviation;
  }
  return least;
}

}  // namespace

double FollowingWatch::excess(const Vector3& dp, const Vector3& dv, const InputParameters& input) {
  const double way = input.tracking_time * dv.norm();
  return std::max(dp.norm() / kPositionNoises, way / kVelocityNoises) / noiseOf(input);
}

void FollowingWatch::note(const UavMeasurement& given, const Vector3& drift, const MotionMemory& motions,
                          const InputParameters& input) {
  if (given.stamp == stamp_) return;
  UavMeasurement measurement = given;
  measurement.p -= drift;
  stamp_ = measurement.stamp;
  const std::optional<Deviation> deviation = leastDeviation(measurement, motions, input);
  const bool was_off = is_off_;
  is_off_ = deviation && deviation->size > 1.0;
  if (is_off_) {
    const bool same_side = was_off && deviation->direction.dot(direction_) > 0.0;
    if ((same_side && stamp_ > settled_) || isNotFollowing()) {
      finding_ = Finding::kDoesNotFollow;
    } else {
      finding_ = Finding::kSuspected;
    }
    direction_ = deviation->direction;
    last_place_ = measurement.p;
    last_off_ = measurement.stamp;
    return;
  }
  const bool has_left = (measurement.p - last_place_).norm() > kPositionNoises * noiseOf(input);
  if (deviation && deviation->size < kOnMotion && has_left) {
    finding_ = Finding::kFollows;
  } else if (isNotFollowing() && measurement.stamp - last_off_ > input.odometry_doubt_time) {
    finding_ = Finding::kSuspected;
  }
}

}  // namespace swarm_planner
