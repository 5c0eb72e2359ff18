// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/text_report.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "swarm_planner/experiments/collision_partner.hpp"
#include "swarm_planner/experiments/fault_report.hpp"
#include "swarm_planner/experiments/flight_ratios.hpp"

namespace swarm_planner {
namespace {

constexpr std::size_t kMostCollisionsListed = 10;

using Row = std::vector<std::string>;

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

std::string fixed(const std::optional<double>& value, int decimals) { return value ? fixed(*value, decimals) : "-"; }

const Row kHeader = {"scenario", "seed",  "UAVs",    "cycle ms",  "p99",    "max",    "pair m",  "clear m",  "coll.",
                     "lag m",    "stuck", "arrived", "mission s", "time x", "path x", "track m", "fallbacks"};

std::size_t fallbackCount(const RunResult& run) {
  std::size_t count = 0;
  for (const auto& reason : run.fallbacks) count += reason.second;
  return count;
}

std::string worst(const std::optional<MeanMax>& ratio) { return ratio ? fixed(ratio->max, 2) : "-"; }

Row toRow(const RunResult& run) {
  const RunSummary& flown = run.flown;
  const FlightRatios ratios = flightRatios(run);
  return {run.scenario,
          std::to_string(run.seed),
          std::to_string(run.uavs),
          fixed(run.cycle_ms.median, 2),
          fixed(run.cycle_ms.p99, 2),
          fixed(run.cycle_ms.max, 2),
          fixed(flown.min_uav_distance, 3),
          fixed(flown.min_obstacle_clearance, 3),
          std::to_string(flown.collisions.size()),
          fixed(flown.final_lag.max, 2),
          std::to_string(flown.stuck_uavs),
          std::to_string(flown.arrived_uavs),
          fixed(flown.mission_time, 2),
          worst(ratios.time),
          worst(ratios.path),
          fixed(flown.tracking_error.mean, 4),
          std::to_string(fallbackCount(run))};
}

std::optional<double> lesser(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

/// The worst of all runs, sums where something is counted, means where a mean is shown.
RunResult overall(const std::vector<RunResult>& results) {
  RunResult all;
  all.scenario = "all " + std::to_string(results.size()) + " runs";
  std::vector<double> medians;
  for (const RunResult& run : results) {
    const RunSummary& flown = run.flown;
    const double share = 1.0 / static_cast<double>(results.size());
    all.uavs += run.uavs;
    medians.push_back(run.cycle_ms.median);
    all.cycle_ms.p99 = std::max(all.cycle_ms.p99, run.cycle_ms.p99);
    all.cycle_ms.max = std::max(all.cycle_ms.max, run.cycle_ms.max);
    all.flown.min_uav_distance = lesser(all.flown.min_uav_distance, flown.min_uav_distance);
    all.flown.min_obstacle_clearance = lesser(all.flown.min_obstacle_clearance, flown.min_obstacle_clearance);
    all.flown.collisions.insert(all.flown.collisions.end(), flown.collisions.begin(), flown.collisions.end());
    all.flown.final_lag.max = std::max(all.flown.final_lag.max, flown.final_lag.max);
    all.flown.stuck_uavs += flown.stuck_uavs;
    all.flown.arrived_uavs += flown.arrived_uavs;
    all.flown.mission_time += share * flown.mission_time;
    all.flown.tracking_error.mean += share * flown.tracking_error.mean;
    all.flown.flights.insert(all.flown.flights.end(), flown.flights.begin(), flown.flights.end());
    all.bounds.insert(all.bounds.end(), run.bounds.begin(), run.bounds.end());
    for (const auto& [reason, count] : run.fallbacks) all.fallbacks[reason] += count;
  }
  all.cycle_ms.median = distributionOf(medians).median;
  return all;
}

/// Columns as wide as they need to be; the first is aligned left, numbers right.
std::string align(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(kHeader.size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - row[i].size(), ' ');
      text += i == 0 ? row[i] + padding : "  " + padding + row[i];
    }
    text += "\n";
  }
  return text;
}

std::string describe(const Collision& collision, const Scenario& scenario) {
  const std::string& uav = scenario.uavs[collision.uav].name;
  return scenario.name + ": " + uav + " too close to " + collisionPartner(collision, scenario) + " at " +
         fixed(collision.time, 2) + " s" + faultsBefore(collision, scenario) + "\n";
}

std::string remarks(const Scenario& scenario, const RunResult& run) {
  std::string text;
  if (run.as_paper) {
    text += scenario.name + ": the paper's method alone\n";
  } else {
    for (const std::string& what : run.left_out) text += scenario.name + ": negative control, without " + what + "\n";
  }
  const std::vector<Collision>& collisions = run.flown.collisions;
  for (std::size_t i = 0; i < std::min(collisions.size(), kMostCollisionsListed); ++i) {
    text += describe(collisions[i], scenario);
  }
  if (collisions.size() > kMostCollisionsListed) {
    text += scenario.name + ": and " + std::to_string(collisions.size() - kMostCollisionsListed) + " more\n";
  }
  if (run.flown.timed_out) text += scenario.name + ": timed out\n";
  if (run.flown.workspace_violations > 0) {
    text += scenario.name + ": left the workspace " + std::to_string(run.flown.workspace_violations) + " times\n";
  }
  if (run.deadline_misses > 0) {
    text += scenario.name + ": " + std::to_string(run.deadline_misses) + " cycles missed their deadline\n";
  }
  for (const auto& [reason, count] : run.fallbacks) {
    text += scenario.name + ": fallback " + std::to_string(count) + " times: " + reason + "\n";
  }
  return text + faultTable(scenario, run);
}

}  // namespace

std::string toTable(const std::vector<ExperimentRun>& runs, const std::vector<RunResult>& results) {
  std::vector<Row> rows = {kHeader};
  std::string notes;
  for (std::size_t i = 0; i < results.size(); ++i) {
    rows.push_back(toRow(results[i]));
    notes += remarks(runs[i].mission.scenario, results[i]);
  }
  if (results.size() > 1) {
    rows.push_back(toRow(overall(results)));
    rows.back()[1] = "";
  }
  return align(rows) + (notes.empty() ? "" : "\n" + notes);
}

}  // namespace swarm_planner
