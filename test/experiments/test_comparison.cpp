// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Problem 1 beside Problem 2: what a reader of the paper looks for first. If these fail, the two are mixed up.
#include <gtest/gtest.h>

#include <sstream>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/experiments/comparison.hpp"
#include "swarm_planner/experiments/experiment_flight.hpp"
#include "swarm_planner/experiments/experiment_program.hpp"
#include "swarm_planner/experiments/json_report.hpp"
#include "swarm_planner/experiments/kkt_nonzeros.hpp"

namespace swarm_planner {
namespace {

ExperimentRun shortRun(PlanningMode mode) {
  Scenario scenario = crossing();
  scenario.end.duration = 6.0;
  return {makeMission(scenario, {}, scenario.name), 0, false, mode, {}};
}

TEST(Comparison, FliesBothProblemsAndTellsWhichIsWhich) {
  const std::vector<ExperimentRun> runs{shortRun(PlanningMode::kIterative), shortRun(PlanningMode::kJoint)};
  std::vector<RunResult> results;
  for (const ExperimentRun& run : runs) results.push_back(flyExperimentRun(run));
  EXPECT_EQ(results[0].mode, PlanningMode::kIterative);
  EXPECT_EQ(results[1].mode, PlanningMode::kJoint);
  EXPECT_EQ(results[0].kkt_nonzeros, kktNonzeros(runs[0].mission));
  EXPECT_EQ(results[1].kkt_nonzeros, jointKktNonzeros(runs[1].mission));
  EXPECT_TRUE(results[1].flown.collisions.empty());

  const Comparison ratio = compare(results[0], results[1]);
  EXPECT_DOUBLE_EQ(ratio.cost, results[1].flown.cost / results[0].flown.cost);
  EXPECT_GT(ratio.kkt_nonzeros, 4.0);
  const std::string table = comparisonTable(runs, results);
  EXPECT_LT(table.find("Problem 2"), table.find("Problem 1"));
  EXPECT_NE(table.find(std::to_string(results[1].kkt_nonzeros)), std::string::npos) << table;

  const std::string json = toJson(runs, results);
  EXPECT_LT(json.find("\"problem\": 2"), json.find("\"problem\": 1")) << json.substr(0, 200);
  EXPECT_NE(json.find("\"problem\": 1"), std::string::npos);
}

TEST(Comparison, SwarmsThatAreTooLargeAreRefusedBeforeAnyFlight) {
  std::ostringstream out, err;
  EXPECT_EQ(runExperimentProgram({"fly", "--joint", "config/scenarios/paper_16.yaml"}, out, err), kExperimentFailed);
  EXPECT_NE(err.str().find("at most 8 UAVs"), std::string::npos) << err.str();
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace swarm_planner
