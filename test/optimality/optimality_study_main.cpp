// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// How far the plans of at most five SQP iterations are from Ipopt's local optima of the same nonlinear programs.
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "optimality/optimality_study.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/experiments/json_object.hpp"
#include "swarm_planner/experiments/progress_bar.hpp"
#include "swarm_planner/experiments/statistics.hpp"

namespace swarm_planner {
namespace {

constexpr double kWithin = 0.01;

struct Method {
  const char* name;
  bool as_paper;
};

/// A flight, every how many cycles its programs are looked at, and how many of them at most.
struct Flight {
  Scenario scenario;
  int stride;
  int most;
};

/// Section 4's example, a larger swarm among the same obstacles, a swap in which all UAVs meet, and flights of the
/// Monte Carlo test, most of whose programs have nothing near.
std::vector<Flight> flights() {
  std::vector<Flight> list = {{paperSix(), 4, 200}, {paperScaling(16), 16, 50}, {circleSwap(10, 10.0, 1), 1, 100}};
  for (std::uint64_t seed = 0; seed < 10; ++seed) list.push_back({paperMonteCarlo(6, seed), 24, 30});
  return list;
}

JsonObject toObject(const ComparedProgram& program) {
  JsonObject object;
  object.add("scenario", program.scenario)
      .addCount("uav", program.uav + 1)
      .add("epoch_s", program.epoch)
      .addFlag("constrained", program.is_constrained)
      .add("start_cost", program.start_cost)
      .add("cost", program.cost)
      .add("ipopt_cost", program.reference)
      .add("gap", program.gap())
      .add("gap_to_nearby_optimum", program.nearbyGap())
      .add("cost_after_50_iterations", program.converged)
      .addCount("sqp_iterations", static_cast<unsigned>(program.iterations))
      .add("slack_m", program.slack)
      .add("ipopt_slack_m", program.reference_slack);
  return object;
}

JsonObject summary(const ComparedPrograms& result, bool constrained_only) {
  std::vector<double> gaps;
  unsigned within = 0, better = 0, sooner_or_later = 0, other_minimum = 0;
  for (const ComparedProgram& program : result.programs) {
    if (constrained_only && !program.is_constrained) continue;
    gaps.push_back(program.gap());
    better += program.gap() < -kWithin ? 1 : 0;
    if (program.gap() <= kWithin) {
      ++within;
    } else if (program.convergedGap() <= kWithin) {
      ++sooner_or_later;
    } else if (program.nearbyGap() <= kWithin) {
      ++other_minimum;
    }
  }
  const auto count = static_cast<unsigned>(gaps.size());
  const Distribution distribution = distributionOf(gaps);
  JsonObject object;
  object.addCount("programs", count)
      .add("within_1_percent", count > 0 ? static_cast<double>(within) / count : 0.0)
      .add("median_gap", distribution.median)
      .add("p99_gap", distribution.p99)
      .add("max_gap", distribution.max)
      .addCount("better_by_1_percent", better)
      .addCount("beyond_more_iterations", sooner_or_later)
      .addCount("beyond_other_minimum", other_minimum)
      .addCount("beyond_no_step", count - within - sooner_or_later - other_minimum);
  return object;
}

JsonObject study(const Method& method, int most) {
  ComparedPrograms result;
  const std::vector<Flight> list = flights();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Scenario& scenario = list[i].scenario;
    const ParameterMap given = method.as_paper ? ParameterMap{{"as_paper", true}} : ParameterMap{{"guide", false}};
    const int left = most - static_cast<int>(result.programs.size());
    if (left <= 0) break;
    compareWithIpopt(makeMission(scenario, given, scenario.name), list[i].stride, std::min(left, list[i].most), result);
    std::fprintf(stderr, "\r%s: flight %zu of %zu, %zu programs ", method.name, i + 1, list.size(),
                 result.programs.size());
  }
  std::fprintf(stderr, "\n");
  std::vector<JsonObject> programs;
  for (const ComparedProgram& program : result.programs) programs.push_back(toObject(program));
  const JsonObject all = summary(result, false);
  std::printf("%s: %s\n", method.name, all.text().c_str());
  std::printf("  with something near: %s\n", summary(result, true).text().c_str());
  JsonObject object;
  object.add("method", method.name)
      .add("all", all)
      .add("constrained", summary(result, true))
      .addCount("ipopt_failed", static_cast<unsigned>(result.failed))
      .add("programs", programs);
  return object;
}

}  // namespace
}  // namespace swarm_planner

int main(int argc, char** argv) {
  using namespace swarm_planner;
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: optimality_study OUTPUT.json [PROGRAMS_OF_EACH_METHOD]\n");
    return 2;
  }
  const int most = argc > 2 ? std::atoi(argv[2]) : 500;
  std::string json = "[\n ";
  json += study({"as_paper", true}, most).text() + ",\n ";
  json += study({"ours", false}, most).text() + "\n]\n";
  std::ofstream file(argv[1]);
  file << json;
  file.close();
  return file.good() ? 0 : 1;
}
