// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/external_flight.hpp"

#include <cmath>
#include <cstddef>

namespace swarm_planner {
namespace {

constexpr double kPeriod = 0.05;  // between setpoints [s]

}  // namespace

ExternalFlight::ExternalFlight(const ScenarioUav& uav) {
  target_.path = ReferencePath(uav.reference);
  target_.start = uav.target.start;
  target_.speed = uav.target.speed;
  setpoints_.points.resize(static_cast<std::size_t>(std::lround(kHorizon / kPeriod)) + 1);
}

const SetpointTrajectory& ExternalFlight::setpoints(double now, double time_zero) {
  target_.time_zero = time_zero;
  setpoints_.epoch = now;
  for (std::size_t i = 0; i < setpoints_.points.size(); ++i) {
    const double elapsed = static_cast<double>(i) * kPeriod;
    const TargetState target = target_.at(now + elapsed);
    setpoints_.points[i].time_from_start = elapsed;
    setpoints_.points[i].p = target.p;
    setpoints_.points[i].v = target.v;
  }
  return setpoints_;
}

}  // namespace swarm_planner
