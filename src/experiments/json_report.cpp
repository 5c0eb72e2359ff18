// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/json_report.hpp"

#include <algorithm>
#include <optional>

#include "swarm_planner/experiments/collision_partner.hpp"
#include "swarm_planner/experiments/fault_report.hpp"
#include "swarm_planner/experiments/flight_ratios.hpp"
#include "swarm_planner/experiments/json_object.hpp"

namespace swarm_planner {
namespace {

JsonObject toObject(const Distribution& x) {
  JsonObject object;
  object.add("mean", x.mean).add("median", x.median).add("p99", x.p99).add("max", x.max);
  return object;
}

JsonObject toObject(const Histogram& x) {
  JsonObject object;
  object.add("least", Histogram::kLeast)
      .addCount("bins_per_decade", Histogram::kBinsPerDecade)
      .addCounts("counts", x.counts);
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

std::vector<JsonObject> collisionEvents(const Scenario& scenario, const std::vector<Collision>& collisions) {
  std::vector<JsonObject> events;
  for (const Collision& collision : collisions) {
    events.emplace_back();
    events.back()
        .add("time_s", collision.time)
        .add("uav", scenario.uavs[collision.uav].name)
        .add("with", collisionPartner(collision, scenario));
  }
  return events;
}

std::vector<JsonObject> flights(const Scenario& scenario, const RunResult& run) {
  std::vector<JsonObject> list;
  for (std::size_t i = 0; i < run.flown.flights.size(); ++i) {
    const UavFlight& flight = run.flown.flights[i];
    std::optional<double> least_time, shortest_path;
    if (i < run.bounds.size()) {
      least_time = run.bounds[i].least_time;
      shortest_path = run.bounds[i].shortest_path;
    }
    list.emplace_back();
    list.back()
        .add("uav", scenario.uavs[i].name)
        .add("arrival_time_s", flight.arrival_time)
        .add("least_time_s", least_time)
        .add("path_length_m", flight.path_length)
        .add("remaining_m", flight.remaining)
        .add("shortest_path_m", shortest_path)
        .addFlag("stuck", flight.stuck)
        .add("lag_m", flight.lag)
        .add("behind_target_m", flight.behind_target)
        .addFlag("target_inside_obstacle", flight.target_inside)
        .add("target_inside_obstacle_ago_s", flight.target_inside_ago);
  }
  return list;
}

/// How the UAVs got on, on top of what the contract asks for.
void addProgress(const Scenario& scenario, const RunResult& run, JsonObject& object) {
  const auto count = [&run](bool (*holds)(const UavFlight&)) {
    const std::vector<UavFlight>& flights = run.flown.flights;
    return static_cast<unsigned long long>(std::count_if(flights.begin(), flights.end(), holds));
  };
  const FlightRatios ratios = flightRatios(run);
  const auto addRatio = [&object](const std::string& key, const std::optional<MeanMax>& ratio) {
    ratio ? object.add(key, toObject(*ratio)) : object.add(key, std::optional<double>());
  };
  object.addFlag("timed_out", run.flown.timed_out);
  addRatio("time_ratio", ratios.time);
  addRatio("path_ratio", ratios.path);
  object.add("mission_time_ratio", ratios.mission)
      .addCount("stuck_with_target_inside_obstacle",
                count([](const UavFlight& flight) { return flight.stuck && flight.target_inside; }))
      .addCount("strayed_uavs", count([](const UavFlight& flight) { return flight.strayed(); }))
      .addCount("strayed_uavs_with_reason", count([](const UavFlight& flight) { return flight.strayedWithReason(); }))
      .add("flights", flights(scenario, run));
}

JsonObject toObject(const Scenario& scenario, const RunResult& run) {
  JsonObject fallbacks;
  for (const auto& [reason, count] : run.fallbacks) fallbacks.addCount(reason, count);
  JsonObject refusals;
  for (const auto& [reason, count] : run.refusals) refusals.addCount(reason, count);
  const RunSummary& flown = run.flown;
  const auto with_obstacle = std::count_if(flown.collisions.begin(), flown.collisions.end(),
                                           [](const Collision& c) { return c.with_obstacle; });
  const auto obstacle_collisions = static_cast<std::size_t>(with_obstacle);
  JsonObject object;
  object.add("scenario", run.scenario)
      .addCount("seed", run.seed)
      .addCount("uavs", run.uavs)
      .addCount("problem", run.mode == PlanningMode::kJoint ? 1U : 2U)
      .add("mode", std::string(planningModeText(run.mode)))
      .addCount("cycles", run.cycles)
      .add("cycle_ms", toObject(run.cycle_ms))
      .add("uav_ms", toObject(run.uav_ms))
      .add("cycle_cpu_ms", toObject(run.cycle_cpu_ms))
      .add("cycle_ms_histogram", toObject(run.cycle_ms_histogram))
      .add("uav_ms_histogram", toObject(run.uav_ms_histogram))
      .add("sqp_iterations", toObject(run.sqp_iterations))
      .add("qp_iterations", toObject(run.qp_iterations))
      .addCount("kkt_nonzeros", static_cast<unsigned long long>(run.kkt_nonzeros))
      .add("min_uav_distance_m", flown.min_uav_distance)
      .add("min_obstacle_clearance_m", flown.min_obstacle_clearance)
      .addCount("collisions", flown.collisions.size())
      .addCount("uav_collisions", flown.collisions.size() - obstacle_collisions)
      .addCount("obstacle_collisions", obstacle_collisions)
      .add("collision_events", collisionEvents(scenario, flown.collisions))
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
      .add("disturbances", disturbances(run.simulation))
      .addFlag("as_paper", run.as_paper)
      .add("without", run.left_out);
  addProgress(scenario, run, object);
  addFaults(run, object);
  return object;
}

}  // namespace

std::string toJson(const std::vector<ExperimentRun>& runs, const std::vector<RunResult>& results) {
  std::string json = "[";
  for (std::size_t i = 0; i < results.size(); ++i) {
    json += (i > 0 ? ",\n " : "\n ") + toObject(runs[i].mission.scenario, results[i]).text();
  }
  return json + "\n]\n";
}

}  // namespace swarm_planner
