// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/comparison.hpp"

#include <cstdio>

namespace swarm_planner {
namespace {

std::string line(const char* problem, const RunResult& run) {
  char text[160];
  std::snprintf(text, sizeof(text), "  %-20s %9.3f %9.3f %9.3f %9.2f %12.2f %12lld %6zu %9zu\n", problem,
                run.cycle_ms.median, run.cycle_ms.p99, run.cycle_ms.max, run.sqp_iterations.mean, run.flown.cost,
                run.kkt_nonzeros, run.flown.collisions.size(), run.rejected_plans);
  return text;
}

}  // namespace

Comparison compare(const RunResult& iterative, const RunResult& joint) {
  return {joint.cycle_ms.median / iterative.cycle_ms.median, joint.flown.cost / iterative.flown.cost,
          static_cast<double>(joint.kkt_nonzeros) / static_cast<double>(iterative.kkt_nonzeros)};
}

std::string comparisonTable(const std::vector<ExperimentRun>& runs, const std::vector<RunResult>& results) {
  std::string table;
  for (std::size_t i = 0; i + 1 < results.size(); i += 2) {
    const RunResult &iterative = results[i], &joint = results[i + 1];
    char head[200];
    std::snprintf(head, sizeof(head), "%s, seed %llu, %zu UAVs\n  %-20s %9s %9s %9s %9s %12s %12s %6s %9s\n",
                  runs[i].mission.scenario.name.c_str(), static_cast<unsigned long long>(iterative.seed),
                  iterative.uavs, "", "cycle ms", "p99", "max", "SQP", "cost", "KKT nonzeros", "coll.", "rejected");
    const Comparison ratio = compare(iterative, joint);
    char tail[160];
    std::snprintf(tail, sizeof(tail), "  %-20s %9.2f %29s %12.4f %12.2f\n\n", "1 over 2", ratio.cycle_time, "",
                  ratio.cost, ratio.kkt_nonzeros);
    table += head + line("Problem 2, one by one", iterative) + line("Problem 1, jointly", joint) + tail;
  }
  return table + "The paper, six UAVs: 35994 nonzeros jointly, 6189 one by one; four to seven times the time.\n";
}

}  // namespace swarm_planner
