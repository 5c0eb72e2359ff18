// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/experiment_flight.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "swarm_planner/experiments/fault_watch.hpp"
#include "swarm_planner/experiments/kkt_nonzeros.hpp"
#include "swarm_planner/experiments/random_missions.hpp"

namespace swarm_planner {
namespace {

/// Resident memory of this process [MB]; 0 where the system does not tell.
double residentMemory() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  if (!(file >> pages >> resident)) return 0.0;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Memory in use when the run is well under way, and at its end.
class MemoryWatch : public RunObserver {
 public:
  explicit MemoryWatch(double duration) : duration_(duration), begin_(std::min(600.0, 0.2 * duration)) {}

  void onSample(double, const std::vector<QuadSimulator>&, const std::vector<Superellipsoid>&) override {}
  void onCycle(double epoch, const CycleReport&) override {
    if (epoch >= begin_ && at_begin == 0.0) at_begin = residentMemory();
    // Of the last cycles, in case the planner is dead at the very end.
    if (epoch >= duration_ - kLast) at_end = residentMemory();
  }

  double at_begin = 0.0, at_end = 0.0;

 private:
  static constexpr double kLast = 10.0;  // [s]
  double duration_, begin_;
};

}  // namespace

RunResult flyExperimentRun(const ExperimentRun& run, std::vector<RunObserver*> observers) {
  const Mission& mission = run.mission;
  SwarmCyclePlanner planner(mission, run.mode);
  ClosedLoopRun flight(mission, planner, run.seed);
  FaultWatch watch(mission, planner);
  if (!mission.scenario.faults.empty()) observers.push_back(&watch);
  if (!run.goals) {
    RunResult result = flight.fly(observers);
    result.faults = watch.summary();
    result.bounds = flightBounds(mission, run.shortest_paths);
    result.mode = run.mode;
    if (run.mode == PlanningMode::kJoint) result.kkt_nonzeros = jointKktNonzeros(mission);
    return result;
  }
  RandomMissions missions(mission, *run.goals, planner, run.seed);
  flight.setDirector(missions);
  MemoryWatch memory(mission.scenario.end.duration.value_or(0.0));
  observers.push_back(&memory);
  RunResult result = flight.fly(observers);
  result.faults = watch.summary();
  result.rehearsal =
      RehearsalSummary{missions.flown(), missions.abandoned(), missions.fewestFlown(), memory.at_begin, memory.at_end};
  return result;
}

}  // namespace swarm_planner
