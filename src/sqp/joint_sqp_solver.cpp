// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/sqp/joint_sqp_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "step_rules.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/separating_planes.hpp"

namespace swarm_planner {

JointSqpSolver::JointSqpSolver(std::unique_ptr<JointQpSolver> qp_solver)
    : qp_solver_(std::move(qp_solver)),
      solution_(std::make_unique<JointQpSolution>()),
      answers_(static_cast<std::size_t>(kMostSqpIterations), std::vector<Trajectory>(kMostJointUavs)),
      candidate_(kMostJointUavs),
      motions_(kMostJointUavs),
      areas_(kMostJointUavs) {
  planes_.of_uavs.resize(kMostJointUavs);
  for (SegmentPlanes& planes : planes_.of_uavs) planes.reserve(kSegmentPlaneRoom);
  planes_.of_pairs.reserve(kMostPairRows);
  for (JointMerit* merit : {&merit_, &candidate_merit_}) {
    merit->of_uavs.reserve(kMostJointUavs);
    merit->of_pairs.reserve(kMostJointUavs * kMostJointUavs);
    merit->largest_violation.reserve(kMostJointUavs);
  }
  results_.reserve(kMostJointUavs);
}

const std::vector<SqpResult>& JointSqpSolver::solve(const JointProblem& problem, JointPlans& plans) {
  const std::size_t count = problem.uavs.size();
  const SqpParameters& settings = problem.uavs.front()->parameters->sqp;
  SqpResult run;
  for (SegmentPlanes& planes : planes_.of_uavs) planes.clear();
  planes_.of_pairs.clear();
  predictAll(plans.plans);
  findJointMerit(problem, plans.plans, motions_, planes_, merit_);
  for (std::size_t i = 0; i < count; ++i) solution_->active[i] = plans.active[i];
  solution_->active_pairs = plans.active_pairs;
  while (run.iterations < settings.max_iterations) {
    const QpStatus status = solveQp(problem, plans.plans, run.iterations);
    ++run.iterations;
    run.qp_iterations += solution_->iterations;
    if (status == QpStatus::kNoAnswer) break;
    run.solved = true;
    const std::vector<Trajectory>& answer = answers_[static_cast<std::size_t>(run.iterations - 1)];
    double wanted = 0.0;
    for (std::size_t i = 0; i < count; ++i) wanted = std::max(wanted, largestMove(plans.plans[i], answer[i]));
    const double promised = qp_.objective(plans.plans) - qp_.objective(answer);
    const double before = merit_.value();
    const double moved = acceptStep(problem, answer, plans.plans);
    const bool foretold = std::abs(before - merit_.value() - promised) < kForetold * promised;
    if (wanted < settings.step_tolerance || foretold || (moved == 0.0 && run.iterations > 1)) break;
  }
  for (std::size_t i = 0; i < count; ++i) plans.active[i] = solution_->active[i];
  plans.active_pairs = solution_->active_pairs;
  run.merit = merit_.value();
  results_.assign(count, run);
  for (std::size_t i = 0; i < count; ++i) results_[i].max_violation = merit_.largest_violation[i];
  return results_;
}

void JointSqpSolver::predictAll(const std::vector<Trajectory>& plans) {
  for (std::size_t i = 0; i < plans.size(); ++i) predict(plans[i], motions_[i]);
}

QpStatus JointSqpSolver::solveQp(const JointProblem& problem, const std::vector<Trajectory>& plans, int iteration) {
  qp_.count = problem.uavs.size();
  qp_.pair_rows.clear();
  planes_.of_pairs.clear();
  double band = 0.0;
  for (std::size_t i = 0; i < qp_.count; ++i) {
    const UavProblem& uav = *problem.uavs[i];
    band = kSampleBand * uav.bounds.max_speed * uav.dt;
    linearise(uav, plans[i], band, *qp_.uavs[i], planes_.of_uavs[i]);
    for (int earlier = 0; earlier < iteration; ++earlier) {
      addNormCuts(uav, answers_[static_cast<std::size_t>(earlier)][i], earlier, *qp_.uavs[i]);
    }
  }
  predictAll(plans);
  findPairPlanes(problem, plans, band);
  addPairRows(problem);
  const QpStatus status = qp_solver_->solve(qp_, *solution_);
  std::vector<Trajectory>& answer = answers_[static_cast<std::size_t>(iteration)];
  answer.resize(qp_.count);
  for (std::size_t i = 0; i < qp_.count; ++i) {
    answer[i].dt = plans[i].dt;
    answer[i].jerks = solution_->jerks[i];
    rollOut(problem.uavs[i]->start, answer[i]);
  }
  return status;
}

void JointSqpSolver::findPairPlanes(const JointProblem& problem, const std::vector<Trajectory>& plans, double band) {
  PlanPoints points;
  std::size_t points_of = problem.uavs.size();
  for (std::size_t index = 0; index < problem.pairs.size(); ++index) {
    const UavPair& pair = problem.pairs[index];
    const UavProblem& first = *problem.uavs[pair.first];
    const MovingBody body = pair.bodyOfSecond(first.start, motions_[pair.second]);
    if (!body.box().near(motions_[pair.first].box, band)) continue;
    if (points_of != pair.first) findConstrainedPoints(first, plans[pair.first], points);
    points_of = pair.first;
    addSeparatingPlanes(first, body, index, points, band, planes_.of_pairs);
  }
}

void JointSqpSolver::addPairRows(const JointProblem& problem) {
  for (std::size_t i = 0; i < planes_.of_pairs.size(); ++i) {
    const SegmentPlane& plane = planes_.of_pairs[i];
    const UavPair& pair = problem.pairs[plane.body];
    for (int j = firstRowPoint(problem.uavs[pair.first]->bounds, planes_.of_pairs, i); j < 4; ++j) {
      const std::optional<RowPlace> place = controlPointPlace(plane.segment, j);
      if (!place) continue;
      qp_.pair_rows.push_back({place->stage, place->output, pair.first, pair.second, plane.half_space.n,
                               plane.half_space.offset, sourceOf(pair) + place->source});
    }
  }
}

/// UAVs that may meet on some way between their plans and the QP's answers, and those with rows in common.
JointComponents JointSqpSolver::findMovingComponents(const JointProblem& problem,
                                                     const std::vector<Trajectory>& answer) {
  JointComponents components = findComponents(qp_);
  for (std::size_t i = 0; i < answer.size(); ++i) {
    areas_[i] = motions_[i].box;
    predict(answer[i], motions_[i]);
    areas_[i].include(motions_[i].box.min);
    areas_[i].include(motions_[i].box.max);
  }
  for (const UavPair& pair : problem.pairs) {
    if (!areas_[pair.first].near(areas_[pair.second], std::max(pair.horizontal, pair.vertical))) continue;
    join(pair.first, pair.second, answer.size(), components);
  }
  return components;
}

double JointSqpSolver::gainOf(const JointProblem& problem, const JointComponents& components,
                              std::size_t component) const {
  double gain = 0.0;
  for (std::size_t i = 0; i < problem.uavs.size(); ++i) {
    if (components[i] == component) gain += merit_.of_uavs[i] - candidate_merit_.of_uavs[i];
  }
  for (std::size_t i = 0; i < problem.pairs.size(); ++i) {
    if (components[problem.pairs[i].first] == component) gain += merit_.of_pairs[i] - candidate_merit_.of_pairs[i];
  }
  return gain;
}

double JointSqpSolver::acceptStep(const JointProblem& problem, const std::vector<Trajectory>& answer,
                                  std::vector<Trajectory>& plans) {
  const std::size_t count = plans.size();
  const JointComponents components = findMovingComponents(problem, answer);
  std::array<bool, kMostJointUavs> decided{};
  candidate_ = plans;
  for (const double length : kStepLengths) {
    for (std::size_t i = 0; i < count; ++i) {
      if (decided[i]) continue;
      stepTowards(solution_->jerks[i], length, problem.uavs[i]->start, plans[i], candidate_[i]);
    }
    predictAll(candidate_);
    findJointMerit(problem, candidate_, motions_, planes_, candidate_merit_);
    bool all = true;
    for (std::size_t component = 0; component < count; ++component) {
      const bool decreases = gainOf(problem, components, component) > 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        if (components[i] == component) decided[i] = decided[i] || decreases;
      }
    }
    for (std::size_t i = 0; i < count; ++i) all = all && decided[i];
    if (all) break;
  }
  double moved = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!decided[i]) candidate_[i] = plans[i];
    moved = std::max(moved, largestMove(plans[i], candidate_[i]));
  }
  plans = candidate_;
  predictAll(plans);
  findJointMerit(problem, plans, motions_, planes_, merit_);
  return moved;
}

}  // namespace swarm_planner
