// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/planning_rounds.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include "swarm_planner/sqp/linearisation.hpp"

namespace swarm_planner {

struct PlanningRounds::Cycle {
  double epoch;
  const PlanningTime& time;
  const std::vector<Turn>& turns;
  std::vector<UavRecord>& records;
  Surroundings& surroundings;
  std::vector<UavReport>& reports;
};

PlanningRounds::PlanningRounds(const Parameters& parameters, const std::optional<Workspace>& workspace,
                               PlanningMode mode, std::size_t uavs, std::size_t max_obstacles, ThreadTeam& team)
    : team_(team), mode_(mode) {
  if (const auto fault = planningModeFault(mode, uavs, parameters.limits.as_paper)) throw std::invalid_argument(*fault);
  order_.reserve(uavs);
  const QpModels models = makeQpModels(parameters);
  const auto tables = std::make_shared<GeneratedTables>(std::vector<QpModel>{models.straight, models.corner});
  const std::size_t bodies = 2 * uavs + max_obstacles;
  for (std::size_t member = 0; member < team.size(); ++member) {
    planners_.emplace_back(parameters, workspace, tables, bodies);
  }
  if (mode == PlanningMode::kIterative) return;
  groups_.emplace(uavs);
  guesses_.resize(uavs);
  candidates_.resize(uavs);
  // One group takes one thread.
  const std::size_t planners = mode == PlanningMode::kJoint ? 1 : team.size();
  for (std::size_t member = 0; member < planners; ++member) {
    joint_planners_.emplace_back(parameters, workspace, tables, bodies, uavs);
  }
}

bool PlanningRounds::plan(double epoch, const PlanningTime& time, const std::vector<Turn>& turns,
                          std::vector<UavRecord>& records, Surroundings& surroundings,
                          std::vector<UavReport>& reports) {
  const Cycle cycle{epoch, time, turns, records, surroundings, reports};
  mode_ == PlanningMode::kIterative ? planOneByOne(cycle) : planByGroups(cycle);
  return noteOverrun(reports);
}

void PlanningRounds::planOneByOne(const Cycle& cycle) {
  order_.build(cycle.surroundings.neighbours(), first_);
  std::atomic<bool> planned{false};
  for (std::size_t round = 0; round < order_.rounds(); ++round) {
    team_.forEach(order_.roundBegin(round), order_.roundBegin(round + 1),
                  [&](std::size_t position, std::size_t member) {
                    const std::size_t i = order_.uav(position);
                    const bool may_skip = cycle.turns[i] == Turn::kPlan && planned.exchange(true);
                    takeTurn(i, may_skip, planners_[member], cycle);
                  });
  }
}

void PlanningRounds::planByGroups(const Cycle& cycle) {
  for (std::size_t i = 0; i < cycle.turns.size(); ++i) {
    const ReferencePath& path = cycle.records[i].reference.path;
    candidates_[i] = {cycle.turns[i] == Turn::kPlan, path.at(path.length()).position};
  }
  if (mode_ == PlanningMode::kJoint) {
    groups_->buildOne(candidates_, cycle.surroundings);
  } else {
    groups_->build(candidates_, cycle.surroundings, team_);
  }
  order_.build(groups_->neighbours(), groups_->groupOf(first_));
  std::atomic<bool> planned{false};
  for (std::size_t round = 0; round < order_.rounds(); ++round) {
    team_.forEach(order_.roundBegin(round), order_.roundBegin(round + 1),
                  [&](std::size_t position, std::size_t member) {
                    const std::size_t group = order_.uav(position);
                    const std::size_t* uavs = groups_->begin(group);
                    const bool may_skip = cycle.turns[uavs[0]] == Turn::kPlan && planned.exchange(true);
                    if (groups_->size(group) > 1 && !(may_skip && cycle.time.isSpent())) {
                      // Of one group it does not matter which member has the planner.
                      JointPlanner& planner = joint_planners_[std::min(member, joint_planners_.size() - 1)];
                      planner.plan(uavs, groups_->size(group), cycle.epoch, cycle.time, guesses_[uavs[0]],
                                   cycle.records, cycle.surroundings, cycle.reports);
                      return;
                    }
                    for (std::size_t i = 0; i < groups_->size(group); ++i)
                      takeTurn(uavs[i], may_skip, planners_[member], cycle);
                  });
  }
}

void PlanningRounds::takeTurn(std::size_t i, bool may_skip, UavPlanner& planner, const Cycle& cycle) {
  UavRecord& record = cycle.records[i];
  UavReport& report = cycle.reports[i];
  if (cycle.turns[i] == Turn::kKeepClear) planner.keepClear(i, cycle.epoch, record, cycle.surroundings, report);
  if (cycle.turns[i] != Turn::kPlan) return;
  if (may_skip && cycle.time.isSpent()) {
    planner.goOn(i, cycle.epoch, record, cycle.surroundings, report);
    reportTask(record.task, report);
  } else {
    planner.plan(i, cycle.epoch, record, cycle.surroundings, report);
  }
}

/// Whose turn came first of those that missed it comes first in the next cycle, so that nobody misses it for ever.
/// By turn, not by round: the first of a later round could be passed over again and again.
bool PlanningRounds::noteOverrun(const std::vector<UavReport>& reports) {
  for (std::size_t turn = 0; turn < reports.size(); ++turn) {
    const std::size_t i = (first_ + turn) % reports.size();
    if (!reports[i].overrun) continue;
    first_ = i;
    return false;
  }
  return true;
}

}  // namespace swarm_planner
