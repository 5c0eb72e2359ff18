// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/model/setpoints.hpp"
#include "swarm_planner/problem/reference_path.hpp"

namespace swarm_planner {

/// The system that flies an external UAV in simulation: it asks the vehicle to be where the target of the UAV's
/// reference is, looks out for nobody, and knows neither corners nor limits. Its commands are never lost or late.
class ExternalFlight {
 public:
  /// How far ahead it commands [s].
  static constexpr double kHorizon = 2.0;

  explicit ExternalFlight(const ScenarioUav& uav);

  /// Commands from `now` [s] on, in a run whose t = 0 is at `time_zero` [s]. Valid until the next call.
  const SetpointTrajectory& setpoints(double now, double time_zero);

 private:
  MovingTarget target_;
  SetpointTrajectory setpoints_;
};

}  // namespace swarm_planner
