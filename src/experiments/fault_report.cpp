// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/fault_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace swarm_planner {
namespace {

constexpr std::size_t kMostMissesListed = 20;
constexpr double kAftermath = 10.0;  // after a fault's end it may be a collision's cause [s]

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

std::string tableLine(const char* kind, const char* injected, const char* noticeable, const char* reported,
                      const char* delay, const char* recovered, const char* recovery) {
  char text[160];
  std::snprintf(text, sizeof(text), "%-20s %8s %10s %8s %7s %9s %9s\n", kind, injected, noticeable, reported, delay,
                recovered, recovery);
  return text;
}

std::string tableLine(const FaultTally& tally) {
  const bool of_uav = faultKindInfo(tally.kind).of_uav;
  const auto count = [](std::size_t number) { return std::to_string(number); };
  return tableLine(faultKindInfo(tally.kind).name, count(tally.injected).c_str(),
                   of_uav ? count(tally.noticeable).c_str() : "-", of_uav ? count(tally.reported).c_str() : "-",
                   tally.reported > 0 ? fixed(tally.report_delay, 2).c_str() : "-", count(tally.recovered).c_str(),
                   fixed(tally.recovery_time, 2).c_str());
}

std::string describe(const FaultMiss& miss) {
  std::string text = faultKindInfo(miss.kind).name;
  if (!miss.uav.empty()) text += " of " + miss.uav;
  text += " at " + fixed(miss.time, 2) + " s:";
  if (miss.unreported) text += " not reported";
  if (std::isfinite(miss.recovery_time)) return text + " flew again after " + fixed(miss.recovery_time, 2) + " s\n";
  return text + " did not fly again\n";
}

std::string rehearsalText(const RehearsalSummary& rehearsal) {
  return std::to_string(rehearsal.goals_reached) + " goals reached, at least " +
         std::to_string(rehearsal.fewest_reached) + " by each UAV, " + std::to_string(rehearsal.goals_abandoned) +
         " given up; resident memory " + fixed(rehearsal.resident_at_begin, 1) + " MB at the beginning, " +
         fixed(rehearsal.resident_at_end, 1) + " MB at the end\n";
}

}  // namespace

std::string faultTable(const Scenario& scenario, const RunResult& run) {
  std::string text;
  if (run.rehearsal) text += scenario.name + ": " + rehearsalText(*run.rehearsal);
  if (run.faults.kinds.empty()) return text;
  text += "\n" + scenario.name + ": faults\n" +
          tableLine("kind", "injected", "noticeable", "reported", "after s", "recovered", "within s");
  for (const FaultTally& tally : run.faults.kinds) text += tableLine(tally);
  text += "waited for an obstacle when they could have flown again: " + std::to_string(run.faults.waited) + "\n";
  const std::vector<FaultMiss>& misses = run.faults.misses;
  for (std::size_t i = 0; i < std::min(misses.size(), kMostMissesListed); ++i) {
    text += scenario.name + ": " + describe(misses[i]);
  }
  if (misses.size() > kMostMissesListed) {
    text += scenario.name + ": and " + std::to_string(misses.size() - kMostMissesListed) + " more\n";
  }
  return text;
}

std::string faultsBefore(const Collision& collision, const Scenario& scenario) {
  std::string text;
  for (const FaultInjection& fault : scenario.faults) {
    const bool before = fault.at <= collision.time && collision.time <= fault.at + fault.duration + kAftermath;
    const bool partner = !collision.with_obstacle && fault.uav == scenario.uavs[collision.partner].name;
    if (!before || !(fault.uav.empty() || partner || fault.uav == scenario.uavs[collision.uav].name)) continue;
    text += std::string(", after ") + faultKindInfo(fault.kind).name;
    if (!fault.uav.empty()) text += " of " + fault.uav;
    text += " at " + fixed(fault.at, 2) + " s";
  }
  return text;
}

void addFaults(const RunResult& run, JsonObject& object) {
  if (!run.faults.kinds.empty()) {
    std::vector<JsonObject> kinds, misses;
    for (const FaultTally& tally : run.faults.kinds) {
      kinds.emplace_back();
      kinds.back().add("kind", std::string(faultKindInfo(tally.kind).name)).addCount("injected", tally.injected);
      kinds.back().addCount("noticeable", tally.noticeable).addCount("reported", tally.reported);
      kinds.back().add("report_delay_s", tally.report_delay).addCount("recovered", tally.recovered);
      kinds.back().add("recovery_s", tally.recovery_time);
    }
    for (const FaultMiss& miss : run.faults.misses) {
      misses.emplace_back();
      misses.back().add("kind", std::string(faultKindInfo(miss.kind).name)).add("time_s", miss.time);
      misses.back().add("uav", miss.uav).addFlag("unreported", miss.unreported).add("recovery_s", miss.recovery_time);
    }
    object.add("faults", kinds).add("fault_misses", misses).add("worst_recovery_s", run.faults.recovery_time);
    object.addCount("waited_for_obstacle", run.faults.waited);
  }
  if (!run.rehearsal) return;
  JsonObject memory, rehearsal;
  memory.add("begin", run.rehearsal->resident_at_begin).add("end", run.rehearsal->resident_at_end);
  rehearsal.addCount("goals_reached", run.rehearsal->goals_reached)
      .addCount("goals_abandoned", run.rehearsal->goals_abandoned)
      .addCount("fewest_reached_by_a_uav", run.rehearsal->fewest_reached)
      .add("resident_mb", memory);
  object.add("rehearsal", rehearsal);
}

}  // namespace swarm_planner
