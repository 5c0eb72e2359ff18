// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/plan_parts.hpp"

#include <algorithm>
#include <array>

#include "swarm_planner/swarm/stopping.hpp"

namespace swarm_planner {
namespace {

/// Knots at which a plan may end in a stop: later ones leave more of it. With less left it is braking.
constexpr std::array<int, 4> kEarlyStops{16, 12, 8, 4};
/// Steps from the motion flown towards the solver's plan.
constexpr std::array<double, 3> kStepsBack{0.5, 0.25, 0.0};

}  // namespace

bool stopEarly(int stage, const FlightBounds& bounds, Trajectory& plan) {
  const auto first = static_cast<std::size_t>(stage);
  StopManoeuvre stop;
  planStop(plan.knots[first], plan.dt, bounds, stop);
  if (!stop.within_bounds || stage + stop.stages > kHorizon) return false;
  const auto jerks = plan.jerks.begin() + stage;
  const auto rest = std::copy(stop.jerks.begin(), stop.jerks.begin() + stop.stages, jerks);
  std::fill(rest, plan.jerks.end(), Vector3(Vector3::Zero()));
  rollOut(plan.knots[0], plan);
  return true;
}

PlanParts::PlanParts(const Trajectory& plan, const Trajectory& shifted, double conflict, const FlightBounds& bounds)
    : plan_(plan), shifted_(shifted), conflict_(conflict), bounds_(bounds) {}

bool PlanParts::next(Trajectory& part) {
  while (next_stop_ < kEarlyStops.size()) {
    const int stage = kEarlyStops[next_stop_++];
    if (stage * plan_.dt >= conflict_) continue;
    part = plan_;
    stops_early_ = stopEarly(stage, bounds_, part);
    if (stops_early_) return true;
  }
  stops_early_ = false;
  if (next_step_ == kStepsBack.size()) return false;
  const double length = kStepsBack[next_step_++];
  part = plan_;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    part.jerks[k] = shifted_.jerks[k] + length * (plan_.jerks[k] - shifted_.jerks[k]);
  }
  rollOut(plan_.knots[0], part);
  stays_ = length == 0.0;
  return true;
}

}  // namespace swarm_planner
