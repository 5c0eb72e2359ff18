// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/experiments/fault_summary.hpp"
#include "swarm_planner/experiments/flight_bounds.hpp"
#include "swarm_planner/experiments/statistics.hpp"
#include "swarm_planner/simulation/run_monitor.hpp"
#include "swarm_planner/swarm/planning_mode.hpp"

namespace swarm_planner {

/// Everything that is reported of one run; doc/experiments.md gives the meaning of every field.
struct RunResult {
  std::string scenario;
  std::uint64_t seed = 0;
  std::size_t uavs = 0;
  PlanningMode mode = PlanningMode::kIterative;
  SimulationParameters simulation;    ///< the disturbances that it was flown with, among others
  bool as_paper = false;              ///< the paper's method alone
  std::vector<std::string> left_out;  ///< of negative_controls.hpp
  std::size_t cycles = 0;
  Distribution cycle_ms;      ///< planning of the whole swarm, snapshot in to plans out [ms]
  Distribution uav_ms;        ///< planning of one UAV [ms]
  Distribution cycle_cpu_ms;  ///< processor time of the same, of the thread that calls the planner [ms]
  Histogram cycle_ms_histogram;
  Histogram uav_ms_histogram;
  MeanMax sqp_iterations;                        ///< per UAV and cycle
  MeanMax qp_iterations;                         ///< per UAV and cycle, all QPs together
  long long kkt_nonzeros = 0;                    ///< see kkt_nonzeros.hpp
  RunSummary flown;                              ///< what the simulated vehicles did
  std::vector<FlightBound> bounds;               ///< what each UAV's flight is measured against
  std::size_t rejected_plans = 0;                ///< plans that the check refused
  std::map<std::string, std::size_t> refusals;   ///< the check's reason in words -> plans
  std::map<std::string, std::size_t> fallbacks;  ///< reason in words -> UAVs and cycles
  std::size_t deadline_misses = 0;               ///< cycles that took longer than cycle_period
  FaultSummary faults;                           ///< of those that were injected
  std::optional<RehearsalSummary> rehearsal;     ///< of a rehearsal alone
};

}  // namespace swarm_planner
