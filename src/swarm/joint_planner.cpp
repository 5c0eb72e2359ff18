// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/joint_planner.hpp"

#include <algorithm>
#include <cmath>

#include "swarm_planner/solver/generated_joint_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"

namespace swarm_planner {
namespace {

constexpr std::size_t kGuessRoom = 256;
/// Changes of the active set per UAV and QP of those that rows connect. Fewer than of a UAV alone, since a change takes
/// the more time the more rows of all are active: where eight meet at one point, four times as many took 130 ms, and
/// the flight was no better.
constexpr int kMostJointChanges = 25;

std::unique_ptr<JointQpSolver> makeSolver(const Parameters& parameters,
                                          const std::shared_ptr<const GeneratedTables>& tables) {
  const QpModels models = makeQpModels(parameters);
  return std::make_unique<GeneratedJointSolver>(std::vector<QpModel>{models.straight, models.corner},
                                                std::make_unique<GeneratedSolver>(tables, kMostQpChanges),
                                                kMostJointChanges);
}

}  // namespace

JointGuess::JointGuess() {
  members.reserve(kMostJointUavs);
  rows.reserve(kGuessRoom);
}

JointPlanner::JointPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
                           const std::shared_ptr<const GeneratedTables>& tables, std::size_t max_bodies,
                           std::size_t uavs)
    : parameters_(parameters), sqp_(makeSolver(parameters, tables)), is_member_(uavs) {
  for (std::size_t i = 0; i < kMostJointUavs; ++i) planners_.emplace_back(parameters, workspace, tables, max_bodies);
  members_.reserve(kMostJointUavs);
  results_.reserve(kMostJointUavs);
  drafts_.reserve(kMostJointUavs);
  problem_.uavs.reserve(kMostJointUavs);
  problem_.pairs.reserve(kMostJointUavs * kMostJointUavs);
  for (JointPlans* plans : {&plans_, &along_}) {
    plans->plans.reserve(kMostJointUavs);
    plans->active.resize(kMostJointUavs);
  }
}

void JointPlanner::plan(const std::size_t* group, std::size_t count, double epoch, const PlanningTime& time,
                        JointGuess& guess, std::vector<UavRecord>& records, Surroundings& surroundings,
                        std::vector<UavReport>& reports) {
  const Stopwatch stopwatch;
  members_.clear();
  for (std::size_t position = 0; position < count; ++position) {
    const std::size_t i = group[position];
    UavPlanner& planner = planners_[members_.size()];
    if (planner.begin(i, epoch, records[i], surroundings, reports[i])) members_.push_back(i);
  }
  if (members_.empty()) return;
  pose(epoch, records, surroundings);
  takeGuess(epoch, guess);
  solve(time, records);
  storeGuess(epoch, guess);
  const bool is_solved = results_.front().solved;
  const bool agreed = is_solved && agree(epoch, records, surroundings);
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const std::size_t i = members_[m];
    records[i].active = plans_.active[m];
    if (agreed || (is_solved && planners_[m].passes(i, epoch, records[i], surroundings))) {
      planners_[m].commitDraft(i, epoch, records[i], surroundings, results_[m], reports[i]);
    } else if (m > 0 && time.isSpent()) {
      planners_[m].goOn(i, epoch, records[i], surroundings, reports[i]);
      reportTask(records[i].task, reports[i]);
    } else {
      planners_[m].planAnew(i, epoch, records[i], surroundings, results_[m], reports[i]);
    }
  }
  const double share = stopwatch.elapsed() / static_cast<double>(members_.size());
  for (const std::size_t i : members_) reports[i].solve_time = share;
}

void JointPlanner::pose(double epoch, std::vector<UavRecord>& records, const Surroundings& surroundings) {
  for (const std::size_t i : members_) is_member_[i] = true;
  plans_.plans.resize(members_.size());
  problem_.uavs.clear();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const std::size_t i = members_[m];
    planners_[m].pose(i, epoch, records[i], surroundings, is_member_, plans_.plans[m]);
    plans_.active[m] = records[i].active;
    problem_.uavs.push_back(&planners_[m].problem());
  }
  for (const std::size_t i : members_) is_member_[i] = false;
  posePairs(surroundings);
}

void JointPlanner::posePairs(const Surroundings& surroundings) {
  problem_.pairs.clear();
  if (!parameters_.limits.avoidance) return;
  for (std::size_t first = 0; first < members_.size(); ++first) {
    const NeighbourLists::List neighbours = surroundings.neighbours().of(members_[first]);
    for (std::size_t second = first + 1; second < members_.size(); ++second) {
      if (!std::binary_search(neighbours.begin(), neighbours.end(), members_[second])) continue;
      UavPair pair = surroundings.pairDistances();
      pair.first = first;
      pair.second = second;
      problem_.pairs.push_back(pair);
    }
  }
}

void JointPlanner::takeGuess(double epoch, const JointGuess& guess) {
  plans_.active_pairs.rows.clear();
  const double stages = std::round((epoch - guess.epoch) / parameters_.time.sampling_time);
  if (guess.members != members_ || stages < 0.0 || stages >= kHorizon) return;
  plans_.active_pairs.rows.assign(guess.rows.begin(), guess.rows.end());
  plans_.active_pairs.shift(static_cast<int>(stages));
}

void JointPlanner::storeGuess(double epoch, JointGuess& guess) const {
  guess.members.assign(members_.begin(), members_.end());
  guess.epoch = epoch;
  const std::vector<ActiveRow>& rows = plans_.active_pairs.rows;
  guess.rows.assign(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(std::min(rows.size(), kGuessRoom)));
}

void JointPlanner::solve(const PlanningTime& time, std::vector<UavRecord>& records) {
  const std::vector<SqpResult>& results = sqp_.solve(problem_, plans_, [&time] { return time.isSpent(); });
  results_.assign(results.begin(), results.end());
  if (!time.isSpent()) solveAlongGuides(time, records);
}

void JointPlanner::solveAlongGuides(const PlanningTime& time, std::vector<UavRecord>& records) {
  bool any = false;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (!records[members_[m]].guide.needsFreshStart()) continue;
    if (!any) {
      along_.plans.assign(plans_.plans.begin(), plans_.plans.end());
      along_.active = plans_.active;
      along_.active_pairs.rows.clear();
      any = true;
    }
    const SqpResult alone = planners_[m].leadAlongGuide(records[members_[m]], along_.plans[m]);
    along_.active[m].count = 0;
    results_[m].iterations += alone.iterations;
    results_[m].qp_iterations += alone.qp_iterations;
  }
  if (!any) return;
  const std::vector<SqpResult>& others = sqp_.solve(problem_, along_, [&time] { return time.isSpent(); });
  const SqpResult first = results_.front(), other = others.front();
  const bool is_better = other.solved && (!first.solved || other.merit < first.merit);
  if (is_better) std::swap(plans_, along_);
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const SqpResult before = results_[m];
    if (is_better) results_[m] = others[m];
    results_[m].iterations = before.iterations + others[m].iterations;
    results_[m].qp_iterations = before.qp_iterations + others[m].qp_iterations;
  }
}

bool JointPlanner::agree(double epoch, std::vector<UavRecord>& records, Surroundings& surroundings) {
  bool all = true;
  drafts_.clear();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const std::size_t i = members_[m];
    drafts_.push_back(&planners_[m].draft(i, plans_.plans[m], records[i], surroundings));
    all = all && drafts_.back()->isFinite();
  }
  if (!all) return false;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    // What a UAV flies now is what it may fly on if its new motion does not arrive.
    surroundings.replaceMotions(members_[m], *drafts_[m], &records[members_[m]].motions.flown());
  }
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const std::size_t i = members_[m];
    all = all && planners_[m].passesAsDrafted(i, epoch, records[i], surroundings);
  }
  for (const std::size_t i : members_) {
    const MotionMemory& motions = records[i].motions;
    surroundings.replaceMotions(i, motions.newest(), motions.olderInFlight(epoch, parameters_.time.cycle_period));
  }
  return all;
}

}  // namespace swarm_planner
