// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "optimality/optimality_study.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "optimality/ipopt_solver.hpp"
#include "swarm_planner/solver/generated_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/sqp_solver.hpp"

namespace swarm_planner {
namespace {

constexpr int kMostQpChanges = 100;  // as in flight
constexpr double kNear = 1.0;        // a segment this near to a body gets constraints at first [m]
constexpr double kMissed = 1e-3;     // violation beyond the slack that shows that one was missed [m]
constexpr int kMostRounds = 4;
constexpr double kFarBetter = 0.01;

using Pairs = std::set<std::pair<std::size_t, int>>;  // body, segment

/// Adds the pairs of bodies and segments that are nearer than `distance` along a plan; returns how many are new.
int addNear(const UavProblem& problem, const Trajectory& plan, double distance, Pairs& pairs) {
  PlanPoints points;
  findConstrainedPoints(problem, plan, points);
  int added = 0;
  for (std::size_t body = 0; body < problem.bodies.size(); ++body) {
    for (int k = 0; k < kHorizon; ++k) {
      const SegmentPoints relative = relativeConstrainedPoints(problem, points, k, problem.bodies[body]);
      if (isBeyond(problem.bodies[body], relative, distance)) continue;
      if (segmentClearance(problem.bodies[body], k, relative).clearance > distance) continue;
      added += pairs.emplace(body, k).second ? 1 : 0;
    }
  }
  return added;
}

/// Ipopt's optimum from `start`. What its answer meets that had no constraints gets them, and it is solved again.
std::optional<ReferenceOptimum> reference(const UavProblem& problem, const Trajectory& start, Pairs& pairs) {
  for (int round = 0; round < kMostRounds; ++round) {
    const ReferenceProgram program(problem, [&pairs](std::size_t body, int k) { return pairs.count({body, k}) > 0; });
    const ReferenceOptimum optimum = solveByIpopt(program, start);
    if (!optimum.found) return {};
    if (addNear(problem, program.planOf(optimum.variables), -kMissed, pairs) == 0) return optimum;
  }
  return {};
}

class Comparison {
 public:
  Comparison(const Mission& mission, int most, ComparedPrograms& result)
      : mission_(mission), solver_(makeSolver(mission.parameters)), most_(most), result_(result) {}

  void compare(const MetProgram& met) {
    if (static_cast<int>(result_.programs.size()) >= most_) return;
    Trajectory plan = met.guess;
    ActiveRows active;
    const SqpResult ours = solver_.solve(met.problem, plan, active);
    ComparedProgram compared{mission_.scenario.name, met.uav, met.epoch};
    compared.start_cost = merit(met.problem, met.guess).value;
    compared.cost = ours.merit;
    compared.iterations = ours.iterations;
    compared.slack = ours.max_violation;
    Pairs pairs;
    addNear(met.problem, met.guess, kNear, pairs);
    addNear(met.problem, plan, kNear, pairs);
    const std::optional<ReferenceOptimum> optimum = reference(met.problem, met.guess, pairs);
    if (!optimum) {
      ++result_.failed;
      return;
    }
    compared.is_constrained = !pairs.empty();
    compared.reference = compared.nearby = optimum->cost;
    compared.reference_slack = optimum->slack;
    if (compared.gap() > kFarBetter) {
      const std::optional<ReferenceOptimum> nearby = reference(met.problem, plan, pairs);
      if (nearby) compared.nearby = nearby->cost;
      compared.converged = convergedCost(met);
    }
    result_.programs.push_back(compared);
  }

 private:
  double convergedCost(const MetProgram& met) {
    Parameters parameters = *met.problem.parameters;
    parameters.sqp.max_iterations = kMostSqpIterations;
    UavProblem problem = met.problem;
    problem.parameters = &parameters;
    Trajectory plan = met.guess;
    ActiveRows active;
    return solver_.solve(problem, plan, active).merit;
  }

  static SqpSolver makeSolver(const Parameters& parameters) {
    const QpModels models = makeQpModels(parameters);
    const auto tables = std::make_shared<GeneratedTables>(std::vector<QpModel>{models.straight, models.corner});
    return SqpSolver(std::make_unique<GeneratedSolver>(tables, kMostQpChanges));
  }

  const Mission& mission_;
  SqpSolver solver_;
  int most_;
  ComparedPrograms& result_;
};

}  // namespace

double ComparedProgram::gap() const { return (cost - reference) / std::max(reference, kLeastCost); }
double ComparedProgram::nearbyGap() const { return (cost - nearby) / std::max(nearby, kLeastCost); }
double ComparedProgram::convergedGap() const { return (converged - reference) / std::max(reference, kLeastCost); }

void compareWithIpopt(const Mission& mission, int stride, int most, ComparedPrograms& result) {
  Comparison comparison(mission, static_cast<int>(result.programs.size()) + most, result);
  visitPrograms(mission, stride, [&comparison](const MetProgram& met) { comparison.compare(met); });
}

}  // namespace swarm_planner
