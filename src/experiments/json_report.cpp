// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/json_report.hpp"

#include "swarm_planner/experiments/json_object.hpp"

namespace swarm_planner {
namespace {

JsonObject toObject(const Distribution& x) {
  JsonObject object;
  object.add("mean", x.mean).add("median", x.median).add("p99", x.p99).add("max", x.max);
  return object;
}

JsonObject disturbances(const SimulationParameters& simulation) {
  JsonObject object;
  object.add("latency_s", simulation.latency)
      .add("jitter_s", simulation.jitter)
      .add("drop", simulation.drop)
      .add("position_noise_m", simulation.position_noise)
      .add("velocity_noise_mps", simulation.velocity_noise)
      .add("position_bias_m", simulation.position_bias)
      .add("wind_mps", simulation.wind);
  return object;
}

JsonObject toObject(const RunResult& run) {
  JsonObject fallbacks;
  for (const auto& [reason, count] : run.fallbacks) fallbacks.addCount(reason, count);
  JsonObject refusals;
  for (const auto& [reason, count] : run.refusals) refusals.addCount(reason, count);
  const RunSummary& flown = run.flown;
  JsonObject object;
  object.add("scenario", run.scenario)
      .addCount("seed", run.seed)
      .addCount("uavs", run.uavs)
      .addCount("cycles", run.cycles)
      .add("cycle_ms", toObject(run.cycle_ms))
      .add("uav_ms", toObject(run.uav_ms))
      .add("sqp_iterations", toObject(run.sqp_iterations))
      .add("qp_iterations", toObject(run.qp_iterations))
      .addCount("kkt_nonzeros", static_cast<unsigned long long>(run.kkt_nonzeros))
      .add("min_uav_distance_m", flown.min_uav_distance)
      .add("min_obstacle_clearance_m", flown.min_obstacle_clearance)
      .addCount("collisions", flown.collisions.size())
      .add("final_lag_m", toObject(flown.final_lag))
      .addCount("stuck_uavs", static_cast<unsigned>(flown.stuck_uavs))
      .add("mission_time_s", flown.mission_time)
      .add("path_length_m", flown.path_length)
      .add("tracking_error_m", toObject(flown.tracking_error))
      .addCount("arrived_uavs", static_cast<unsigned>(flown.arrived_uavs))
      .addCount("rejected_plans", run.rejected_plans)
      .add("refusals", refusals)
      .addCount("workspace_violations", static_cast<unsigned>(flown.workspace_violations))
      .add("fallbacks", fallbacks)
      .addCount("deadline_misses", run.deadline_misses)
      .add("cost", flown.cost)
      .add("disturbances", disturbances(run.simulation));
  return object;
}

}  // namespace

std::string toJson(const std::vector<RunResult>& results) {
  std::string json = "[";
  for (const RunResult& run : results) json += (json.size() > 1 ? ",\n " : "\n ") + toObject(run).text();
  return json + "\n]\n";
}

}  // namespace swarm_planner
