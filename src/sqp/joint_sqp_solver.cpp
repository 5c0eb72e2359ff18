// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/sqp/joint_sqp_solver.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "step_rules.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/sqp/separating_planes.hpp"

namespace swarm_planner {
namespace {

// See JointSqpSolver::sourceOf.
std::size_t firstOf(RowSource source) { return source / 2 / kMostJointUavs; }
std::size_t secondOf(RowSource source) { return source / 2 % kMostJointUavs; }

}  // namespace

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
  kept_rows_.reserve(kMostPairRows);
}

const std::vector<SqpResult>& JointSqpSolver::solve(const JointProblem& problem, JointPlans& plans,
                                                    const IsSpent& is_spent) {
  const std::size_t count = problem.uavs.size();
  for (SegmentPlanes& planes : planes_.of_uavs) planes.clear();
  planes_.of_pairs.clear();
  predictAll(plans.plans);
  findJointMerit(problem, plans.plans, motions_, planes_, merit_);
  for (std::size_t i = 0; i < count; ++i) solution_->active[i] = plans.active[i];
  solution_->active_pairs = plans.active_pairs;
  is_done_.fill(false);
  results_.assign(count, SqpResult());
  const auto end = is_done_.begin() + static_cast<std::ptrdiff_t>(count);
  const int most = problem.uavs.front()->parameters->sqp.max_iterations;
  for (int iteration = 0; iteration < most && std::find(is_done_.begin(), end, false) != end; ++iteration) {
    const QpStatus status = solveQp(problem, plans.plans, iteration);
    for (std::size_t i = 0; i < count; ++i) {
      if (qp_.is_left[i]) continue;
      ++results_[i].iterations;
      results_[i].qp_iterations += solution_->iterations;
    }
    if (status == QpStatus::kNoAnswer) break;
    for (SqpResult& result : results_) result.solved = true;
    const std::vector<Trajectory>& answer = answers_[static_cast<std::size_t>(iteration)];
    const JointComponents components = findMovingComponents(problem, answer);
    findStep(problem, components, plans.plans);
    takeStep(problem, components, answer, plans.plans);
    if (is_spent()) break;
  }
  for (std::size_t i = 0; i < count; ++i) {
    plans.active[i] = solution_->active[i];
    results_[i].merit = merit_.value();
    results_[i].max_violation = merit_.largest_violation[i];
  }
  plans.active_pairs = solution_->active_pairs;
  return results_;
}

void JointSqpSolver::predictAll(const std::vector<Trajectory>& plans) {
  for (std::size_t i = 0; i < plans.size(); ++i) predict(plans[i], motions_[i]);
}

QpStatus JointSqpSolver::solveQp(const JointProblem& problem, const std::vector<Trajectory>& plans, int iteration) {
  qp_.count = problem.uavs.size();
  const FlightBounds& bounds = problem.uavs.front()->bounds;
  const double band = kSampleBand * bounds.max_speed * problem.uavs.front()->dt;
  predictAll(plans);
  planes_.of_pairs.clear();
  findPairPlanes(problem, plans, band);
  leaveThoseDone(problem);
  for (std::size_t i = 0; i < qp_.count; ++i) {
    const UavProblem& uav = *problem.uavs[i];
    if (qp_.is_left[i]) continue;
    linearise(uav, plans[i], band, *qp_.uavs[i], planes_.of_uavs[i]);
    for (int earlier = 0; earlier < iteration; ++earlier) {
      addNormCuts(uav, answers_[static_cast<std::size_t>(earlier)][i], earlier, *qp_.uavs[i]);
    }
  }
  qp_.pair_rows.clear();
  addPairRows(problem);
  const QpStatus status = qp_solver_->solve(qp_, *solution_);
  std::vector<ActiveRow>& active_pairs = solution_->active_pairs.rows;
  active_pairs.insert(active_pairs.end(), kept_rows_.begin(), kept_rows_.end());
  std::vector<Trajectory>& answer = answers_[static_cast<std::size_t>(iteration)];
  answer.resize(qp_.count);
  for (std::size_t i = 0; i < qp_.count; ++i) {
    answer[i].dt = plans[i].dt;
    if (qp_.is_left[i]) solution_->jerks[i] = plans[i].jerks;
    answer[i].jerks = solution_->jerks[i];
    rollOut(problem.uavs[i]->start, answer[i]);
  }
  return status;
}

void JointSqpSolver::leaveThoseDone(const JointProblem& problem) {
  JointComponents components;
  std::iota(components.begin(), components.end(), std::size_t{0});
  for (const SegmentPlane& plane : planes_.of_pairs) {
    join(problem.pairs[plane.body].first, problem.pairs[plane.body].second, qp_.count, components);
  }
  qp_.is_left.fill(true);
  for (std::size_t i = 0; i < qp_.count; ++i) {
    for (std::size_t other = 0; other < qp_.count && !is_done_[i]; ++other) {
      if (components[other] == components[i]) qp_.is_left[other] = false;
    }
  }
  kept_rows_.clear();
  for (const ActiveRow& row : solution_->active_pairs.rows) {
    if (qp_.is_left[firstOf(row.source)] && qp_.is_left[secondOf(row.source)]) kept_rows_.push_back(row);
  }
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
    if (qp_.is_left[pair.first]) continue;
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

double JointSqpSolver::meritOf(const JointMerit& merit, const JointProblem& problem, const JointComponents& components,
                               std::size_t component) {
  double sum = 0.0;
  for (std::size_t i = 0; i < problem.uavs.size(); ++i) {
    if (components[i] == component) sum += merit.of_uavs[i];
  }
  for (std::size_t i = 0; i < problem.pairs.size(); ++i) {
    if (components[problem.pairs[i].first] == component) sum += merit.of_pairs[i];
  }
  return sum;
}

void JointSqpSolver::findStep(const JointProblem& problem, const JointComponents& components,
                              const std::vector<Trajectory>& plans) {
  const std::size_t count = plans.size();
  std::array<bool, kMostJointUavs> decided = qp_.is_left;
  for (std::size_t i = 0; i < count; ++i) moves_[i] = !qp_.is_left[i];
  candidate_ = plans;
  for (const double length : kStepLengths) {
    for (std::size_t i = 0; i < count; ++i) {
      if (decided[i]) continue;
      stepTowards(solution_->jerks[i], length, problem.uavs[i]->start, plans[i], candidate_[i]);
    }
    judgeCandidate(problem);
    bool all = true;
    for (std::size_t i = 0; i < count; ++i) {
      decided[i] = decided[i] || meritOf(candidate_merit_, problem, components, components[i]) <
                                     meritOf(merit_, problem, components, components[i]);
      all = all && decided[i];
    }
    if (all) break;
  }
  for (std::size_t i = 0; i < count; ++i) {
    moves_[i] = moves_[i] && decided[i];
    if (!moves_[i]) candidate_[i] = plans[i];
  }
}

void JointSqpSolver::judgeCandidate(const JointProblem& problem) {
  predictAll(candidate_);
  findJointMerit(problem, candidate_, motions_, planes_, candidate_merit_);
  for (std::size_t i = 0; i < problem.uavs.size(); ++i) {
    if (moves_[i]) continue;
    candidate_merit_.of_uavs[i] = merit_.of_uavs[i];
    candidate_merit_.largest_violation[i] = merit_.largest_violation[i];
  }
  for (std::size_t i = 0; i < problem.pairs.size(); ++i) {
    const UavPair& pair = problem.pairs[i];
    if (!moves_[pair.first] && !moves_[pair.second]) candidate_merit_.of_pairs[i] = merit_.of_pairs[i];
  }
}

bool JointSqpSolver::leans(const JointProblem& problem, const JointComponents& components,
                           std::size_t component) const {
  for (std::size_t i = 0; i < problem.uavs.size(); ++i) {
    if (components[i] == component && leansOnBodies(solution_->active[i])) return true;
  }
  const std::vector<ActiveRow>& pairs = solution_->active_pairs.rows;
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const ActiveRow& row) { return components[firstOf(row.source)] == component; });
}

void JointSqpSolver::takeStep(const JointProblem& problem, const JointComponents& components,
                              const std::vector<Trajectory>& answer, std::vector<Trajectory>& plans) {
  const std::size_t count = plans.size();
  judgeCandidate(problem);
  for (std::size_t component = 0; component < count; ++component) {
    double wanted = 0.0, moved = 0.0;
    int iterations = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (components[i] != component || qp_.is_left[i]) continue;
      wanted = std::max(wanted, largestMove(plans[i], answer[i]));
      moved = std::max(moved, largestMove(plans[i], candidate_[i]));
      iterations = std::max(iterations, results_[i].iterations);
    }
    const double merit = meritOf(candidate_merit_, problem, components, component);
    const double gain = meritOf(merit_, problem, components, component) - merit;
    const double promised =
        objective(qp_, plans, components, component) - objective(qp_, answer, components, component);
    const bool is_foretold = isForetold(gain, promised, merit, leans(problem, components, component), iterations);
    const double tolerance = problem.uavs.front()->parameters->sqp.step_tolerance;
    const bool is_done = wanted < tolerance || is_foretold || (moved == 0.0 && iterations > 1);
    for (std::size_t i = 0; i < count; ++i) {
      if (components[i] == component) is_done_[i] = is_done;
    }
  }
  plans = candidate_;
  std::swap(merit_, candidate_merit_);
}

}  // namespace swarm_planner
