// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/foreign_body.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

constexpr double kLeastRadius = 0.01;  // where uav_radius takes up all of a pair distance [m]

/// `growth_rate`: of the doubt [m/s].
ForeignBody makeBody(std::size_t uav, const UavMeasurement& measurement, const Vector3& center, const Vector3& velocity,
                     double growth_rate, const Parameters& parameters) {
  const LimitParameters& limits = parameters.limits;
  const double horizontal = std::max(limits.pair_distance - limits.uav_radius, kLeastRadius);
  const double vertical = std::max(limits.pair_distance_vertical - limits.uav_radius, kLeastRadius);
  // No obstacle of a scenario has a negative number.
  const int id = -1 - static_cast<int>(uav);
  ForeignBody body;
  body.shape =
      Superellipsoid(id, center, Vector3(horizontal, horizontal, vertical), Vector3::Constant(2.0), 0.0, velocity);
  body.stamp = measurement.stamp;
  body.inflation.at_stamp = limits.tracking_error + parameters.input.odometry_noise;
  body.inflation.growth_rate = growth_rate;
  body.inflation.growth_time = growth_rate > 0.0 ? parameters.input.lost_growth_limit / growth_rate : 0.0;
  return body;
}

}  // namespace

ForeignBody seenForeign(std::size_t uav, const UavMeasurement& measurement, const Parameters& parameters) {
  return makeBody(uav, measurement, measurement.p, measurement.v, parameters.input.lost_growth_rate, parameters);
}

ForeignBody unseenForeign(std::size_t uav, const UavMeasurement& last, const Parameters& parameters) {
  const Vector3 center = last.p + parameters.input.odometry_timeout * last.v;
  return makeBody(uav, last, center, Vector3::Zero(), parameters.input.lost_growth_rate + last.v.norm(), parameters);
}

}  // namespace swarm_planner
