// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/joint_planner.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "swarm_planner/solver/generated_joint_solver.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"

namespace swarm_planner {
namespace {

std::unique_ptr<JointQpSolver> makeSolver(const Parameters& parameters) {
  const QpModels models = makeQpModels(parameters);
  return std::make_unique<GeneratedJointSolver>(std::vector<QpModel>{models.straight, models.corner});
}

}  // namespace

std::optional<std::string> planningModeFault(PlanningMode mode, std::size_t uavs) {
  if (mode == PlanningMode::kIterative || uavs <= kMostJointUavs) return {};
  return "the joint problem is solved for at most " + std::to_string(kMostJointUavs) + " UAVs, the scenario has " +
         std::to_string(uavs);
}

JointPlanner::JointPlanner(const Parameters& parameters, const std::optional<Workspace>& workspace,
                           std::shared_ptr<const GeneratedTables> tables, std::size_t max_bodies, std::size_t uavs)
    : parameters_(parameters), sqp_(makeSolver(parameters)), is_member_(uavs) {
  if (const auto fault = planningModeFault(PlanningMode::kJoint, uavs)) throw std::invalid_argument(*fault);
  for (std::size_t i = 0; i < uavs; ++i) planners_.emplace_back(parameters, workspace, tables, max_bodies);
  members_.reserve(uavs);
  solved_.reserve(uavs);
  drafts_.reserve(uavs);
  problem_.uavs.reserve(uavs);
  problem_.pairs.reserve(uavs * uavs);
  plans_.plans.reserve(uavs);
  plans_.active.resize(uavs);
}

void JointPlanner::plan(double epoch, const std::function<bool(std::size_t)>& is_to_plan,
                        std::vector<UavRecord>& records, Surroundings& surroundings, std::vector<UavReport>& reports) {
  const Stopwatch stopwatch;
  members_.clear();
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (is_to_plan(i) && planners_[i].begin(i, epoch, records[i], surroundings, reports[i])) members_.push_back(i);
  }
  if (members_.empty()) return;
  pose(epoch, records, surroundings);
  const std::vector<SqpResult>& results = sqp_.solve(problem_, plans_);
  const bool agreed = results.front().solved && agree(epoch, records, surroundings);
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const std::size_t i = members_[m];
    records[i].active = plans_.active[m];
    if (agreed) {
      planners_[i].commitDraft(i, epoch, records[i], surroundings, results[m], reports[i]);
    } else {
      planners_[i].complete(i, epoch, records[i], surroundings, results[m], reports[i]);
    }
  }
  const double share = stopwatch.elapsed() / static_cast<double>(members_.size());
  for (const std::size_t i : members_) reports[i].solve_time = share;
}

void JointPlanner::pose(double epoch, std::vector<UavRecord>& records, const Surroundings& surroundings) {
  const double stages = std::round((epoch - guess_epoch_) / parameters_.time.sampling_time);
  if (solved_ == members_ && stages >= 0.0 && stages < kHorizon) {
    plans_.active_pairs.shift(static_cast<int>(stages));
  } else {
    plans_.active_pairs.rows.clear();
  }
  solved_ = members_;
  guess_epoch_ = epoch;

  std::fill(is_member_.begin(), is_member_.end(), false);
  for (const std::size_t i : members_) is_member_[i] = true;
  plans_.plans.resize(members_.size());
  problem_.uavs.clear();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const std::size_t i = members_[m];
    planners_[i].pose(i, epoch, records[i], surroundings, is_member_, plans_.plans[m]);
    plans_.active[m] = records[i].active;
    problem_.uavs.push_back(&planners_[i].problem());
  }
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

bool JointPlanner::agree(double epoch, std::vector<UavRecord>& records, Surroundings& surroundings) {
  bool all = true;
  drafts_.clear();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    drafts_.push_back(&planners_[members_[m]].draft(plans_.plans[m]));
    all = all && drafts_.back()->isFinite();
  }
  if (!all) return false;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    // What a UAV flies now is what it may fly on if its new motion does not arrive.
    surroundings.replaceMotions(members_[m], *drafts_[m], &records[members_[m]].motions.flown());
  }
  for (const std::size_t i : members_) all = all && planners_[i].passes(i, epoch, records[i], surroundings);
  for (const std::size_t i : members_) {
    const MotionMemory& motions = records[i].motions;
    surroundings.replaceMotions(i, motions.newest(), motions.olderInFlight(epoch, parameters_.time.cycle_period));
  }
  return all;
}

}  // namespace swarm_planner
