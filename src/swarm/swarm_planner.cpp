// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/swarm_planner.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "swarm_planner/obstacles/track_memory.hpp"
#include "swarm_planner/swarm/flight_director.hpp"
#include "swarm_planner/swarm/foreign_body.hpp"
#include "swarm_planner/swarm/guide_desk.hpp"
#include "swarm_planner/swarm/planning_rounds.hpp"
#include "swarm_planner/swarm/reference_rules.hpp"
#include "swarm_planner/swarm/right_of_way.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/takeover.hpp"
#include "swarm_planner/swarm/thread_team.hpp"

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Vector3> homesOf(const Scenario& scenario) {
  std::vector<Vector3> homes;
  for (const ScenarioUav& uav : scenario.uavs) homes.push_back(uav.start);
  return homes;
}

}  // namespace

class SwarmPlanner::Impl {
 public:
  Impl(const Mission& mission, PlanningMode mode)
      : parameters(mission.parameters),
        uavs(mission.scenario.uavs.size()),
        bounds(parameters, mission.scenario.workspace ? &*mission.scenario.workspace : nullptr),
        tracks(parameters.input.track_timeout, maxTracks(mission), uavs.size()),
        surroundings(parameters, uavs.size(), maxTracks(mission)),
        takeover(homesOf(mission.scenario), parameters.limits),
        director(mission, parameters),
        guides(parameters, mission.scenario.workspace, uavs.size(), maxTracks(mission)),
        right_of_way(mission, parameters),
        team(static_cast<std::size_t>(parameters.compute.threads)),
        rounds(parameters, mission.scenario.workspace, mode, uavs.size(), maxTracks(mission), team),
        judged(uavs.size()),
        turns(uavs.size()) {
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      const ScenarioUav& uav = mission.scenario.uavs[i];
      uavs[i].name = uav.name;
      uavs[i].foreign = uav.external;
      if (uav.external) uavs[i].task.mode = FlightMode::kAbsent;
      uavs[i].beginning.home = uav.start;
      uavs[i].setReference(uav.reference, uav.target.start, uav.target.speed);
    }
    report.uavs.resize(uavs.size());
    places.reserve(uavs.size());
    foreign_bodies.reserve(uavs.size());
  }

  void reset() {
    report.started = false;
    planning = false;
    takeover.reset();
    tracks.reset();
    for (UavRecord& uav : uavs) uav.reset();
  }

  CommandAnswer command(std::size_t i, FlightCommand command) {
    FlightTask& task = uavs[i].task;
    const FlightMode before = task.mode;
    const FlightTransition change = transition(before, eventOf(command, activityBeside(i)));
    if (change.answer == FlightAnswer::kDone) enter(i, change.mode);
    const bool lost = report.uavs[i].state == UavState::kLost;
    const Delay delay = !report.started ? Delay::kRunNotStarted : lost ? Delay::kOdometryLost : Delay::kNone;
    return answerTo(command, before, change, delay);
  }

  void enter(std::size_t i, FlightMode mode) {
    UavRecord& uav = uavs[i];
    if (uav.task.mode == FlightMode::kFlying) uav.pauseReference(report.epoch);
    uav.setForeign(mode == FlightMode::kAbsent);
    uav.task.enter(mode);
  }

  void takeOver(const FlightMemory& memory) {
    report.started = true;
    report.time_zero = memory.time_zero;
    double last_epoch = 0.0;
    for (const UavMemory& uav : memory.uavs) last_epoch = std::max(last_epoch, uav.epoch);
    takeover.reset(memory.obstacles, last_epoch);
    const std::size_t count = std::min(uavs.size(), memory.uavs.size());
    for (std::size_t i = 0; i < count; ++i) swarm_planner::takeOver(memory.uavs[i], uavs[i]);
    beginRun();
  }

  void plan(const Snapshot& snapshot, double epoch, double budget) {
    const Stopwatch stopwatch;
    ++report.cycle;
    report.epoch = epoch;
    report.out_of_time = false;
    tracks.update(snapshot.obstacles, snapshot.now);
    judgeMeasurements(snapshot);
    report.refused_tracks = tracks.refused() + tracks.keepNearest(measuredPlaces(snapshot));
    observeBeginners(snapshot);
    if (!planning) start(epoch);
    if (planning) {
      guides.takeAnswers(uavs);
      planAll(snapshot, epoch, stopwatch, budget);
      guides.ask(epoch, tracks.tracks(), foreign_bodies, snapshot.map, uavs);
    }
    report.cycle_time = stopwatch.elapsed();
  }

  bool searchGuides() { return guides.search(); }

  const Parameters parameters;
  std::vector<UavRecord> uavs;
  const FlightBounds bounds;
  CycleReport report;

 private:
  const std::vector<Vector3>& measuredPlaces(const Snapshot& snapshot) {
    places.clear();
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if (judged[i] == Reason::kNone) places.push_back(snapshot.uavs[i].p);
    }
    return places;
  }

  void judgeMeasurements(const Snapshot& snapshot) {
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      const UavMeasurement none;
      judged[i] = uavs[i].monitor.judge(i < snapshot.uavs.size() ? snapshot.uavs[i] : none, snapshot.now,
                                        uavs[i].motions, parameters);
      UavReport& uav_report = report.uavs[i];
      uav_report = UavReport();
      uav_report.obstacle_clearance = uav_report.pair_distance = kInfinity;
      uav_report.state = report.started && judged[i] != Reason::kNone ? UavState::kLost : UavState::kHolding;
      uav_report.reason = judged[i];
      const FlightTask& task = uavs[i].task;
      if (judged[i] != Reason::kNone) continue;
      if (!report.started && !uavs[i].foreign) {
        const bool commanded = parameters.input.autostart || isPlannedFor(task.mode);
        uav_report.reason = commanded ? Reason::kWaitingForOthers : Reason::kWaitingForStart;
      } else if (!isPlannedFor(task.mode)) {
        reportTask(task, uav_report);
      }
    }
  }

  void observeBeginners(const Snapshot& snapshot) {
    takeover.beginCycle(snapshot.now);
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      const bool begins = uavs[i].beginning.pending && !uavs[i].foreign;
      if (begins && judged[i] == Reason::kNone) takeover.observe(i, snapshot.uavs[i]);
    }
  }

  /// Begins to plan if it is time to: on the ground when the odometry of every UAV of the swarm has arrived, in flight
  /// when the takeover is ready.
  void start(double epoch) {
    const bool in_flight = report.started || takeover.findsFlight();
    const bool commanded = report.started || isCommanded();
    planning = commanded && (in_flight ? takeover.isReady(tracks.tracks().size()) : allArrived());
    if (planning && !report.started) {
      report.started = true;
      report.time_zero = epoch;
      beginRun();
    }
    if (in_flight && commanded) reportTakeover();
  }

  void reportTakeover() {
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if (uavs[i].foreign) continue;
      if (judged[i] != Reason::kNone) {
        report.uavs[i].state = UavState::kLost;
      } else if (!planning) {
        report.uavs[i].state = UavState::kFallback;
        report.uavs[i].reason = Reason::kTakingOver;
      }
    }
  }

  bool allArrived() const {
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if (!uavs[i].foreign && judged[i] != Reason::kNone) return false;
    }
    return true;
  }

  /// Whether some UAV is to be planned for.
  bool isCommanded() const {
    return std::any_of(uavs.begin(), uavs.end(), [this](const UavRecord& uav) {
      return !uav.foreign && (parameters.input.autostart || isPlannedFor(uav.task.mode));
    });
  }

  void beginRun() {
    if (!parameters.input.autostart) return;
    for (UavRecord& uav : uavs) uav.task.mode = transition(uav.task.mode, FlightEvent::kRunStarts).mode;
  }

  /// What the swarm does, but for UAV i.
  SwarmActivity activityBeside(std::size_t i) const {
    if (!report.started) return SwarmActivity::kWaiting;
    for (std::size_t other = 0; other < uavs.size(); ++other) {
      if (other != i && uavs[other].task.mode == FlightMode::kFlying) return SwarmActivity::kFlying;
    }
    return SwarmActivity::kHolding;
  }

  void planAll(const Snapshot& snapshot, double epoch, const Stopwatch& stopwatch, double budget) {
    surroundings.setEpoch(epoch, snapshot.map.get());
    surroundings.setObstacles(tracks.tracks(), snapshot.now);
    foreign_bodies.clear();
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      // One that has joined and is not seen is still where it was as a foreign one.
      if (!isPlannedFor(uavs[i].task.mode) ||
          (uavs[i].unseen && judged[i] != Reason::kNone && uavs[i].motions.empty())) {
        addForeign(i, snapshot);
      }
    }
    team.forEach(0, uavs.size(), [&](std::size_t i, std::size_t) { prepare(i, snapshot, epoch); });
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if ((uavs[i].unseen || uavs[i].aside) && !uavs[i].motions.empty()) {
        surroundings.setDoubt(i, uavs[i].doubt(parameters.input), uavs[i].aside ? &*uavs[i].aside : nullptr);
      }
    }
    director.assignSites(epoch, tracks.tracks(), judged, uavs, snapshot.map.get());
    surroundings.findNeighbours();
    right_of_way.direct(epoch, tracks.tracks(), judged, surroundings.neighbours(), uavs, snapshot.map.get());
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      turns[i] = isToPlan(i) ? Turn::kPlan : isToKeepClear(i) ? Turn::kKeepClear : Turn::kNone;
    }
    report.out_of_time = !rounds.plan(epoch, {stopwatch, budget}, turns, uavs, surroundings, report.uavs);
  }

  /// Whether it is not seen, but flies what was planned for it.
  bool isToKeepClear(std::size_t i) const {
    const UavRecord& uav = uavs[i];
    const FlightMode mode = uav.task.mode;
    return uav.unseen && uav.planned && isPlannedFor(mode) && mode != FlightMode::kLanded && !uav.motions.empty();
  }

  bool isToPlan(std::size_t i) const { return judged[i] == Reason::kNone && isPlannedFor(uavs[i].task.mode); }

  /// Tells the surroundings where a UAV is that another system flies. What it was to fly here counts until odometry
  /// shows it elsewhere, or it has ended.
  void addForeign(std::size_t i, const Snapshot& snapshot) {
    UavRecord& uav = uavs[i];
    const bool seen = judged[i] == Reason::kNone;
    if (seen && !uav.motions.empty() && !uav.isOnMotion(snapshot.uavs[i], parameters)) uav.forgetMotions();
    // On its motion it is where everybody's plans were checked against. To demand that it may as well fly straight on
    // would leave UAVs that are close to it no plan.
    if (seen && !uav.motions.empty()) return;
    const std::optional<UavMeasurement>& last = uav.monitor.trusted();
    // Before it is seen first it is where the scenario starts it.
    const UavMeasurement at_start{false, snapshot.now, uavs[i].beginning.home, Vector3::Zero()};
    foreign_bodies.push_back(seen   ? seenForeign(i, *last, parameters)
                             : last ? unseenForeign(i, *last, parameters)
                                    : seenForeign(i, at_start, parameters));
    const ForeignBody& body = foreign_bodies.back();
    surroundings.addObstacle(body.shape, body.stamp, body.inflation);
  }

  /// Tells the surroundings what the UAV does until it has a new plan, and how far a new one can take it.
  void prepare(std::size_t i, const Snapshot& snapshot, double epoch) {
    UavRecord& uav = uavs[i];
    if (uav.reference_pending && uav.task.mode == FlightMode::kFlying) {
      uav.reference.time_zero = epoch;
      uav.reference_pending = false;
    }
    if (isToPlan(i)) {
      if (uav.beginning.pending) {
        // One that is seen later than the others is in flight, too, if they are.
        const ObservedFlight* flight = takeover.findsFlight() ? &takeover.flight(i) : nullptr;
        begin(snapshot.uavs[i], epoch, parameters, bounds, flight, uav);
      } else {
        uav.predictStart(snapshot.uavs[i], epoch, parameters, bounds);
      }
      director.direct(epoch, snapshot.uavs[i], uav, snapshot.map.get());
    } else if (isPlannedFor(uav.task.mode)) {
      uav.loseSight(parameters, bounds);
    }
    if (uav.motions.empty()) {
      surroundings.setUnknown(i);
    } else {
      surroundings.setMotions(i, uav.motions.newest(), uav.motions.olderInFlight(epoch, parameters.time.cycle_period));
    }
    if (isToPlan(i)) surroundings.setPlanning(i, uav.start);
    if (isToKeepClear(i)) surroundings.setPlanning(i, uav.motions.flown().at(epoch));
  }

  TrackMemory tracks;
  std::vector<ForeignBody> foreign_bodies;  ///< of this cycle
  Surroundings surroundings;
  Takeover takeover;
  bool planning = false;  ///< the first plans have been made
  FlightDirector director;
  GuideDesk guides;
  RightOfWay right_of_way;
  ThreadTeam team;
  PlanningRounds rounds;
  std::vector<Reason> judged;   ///< of each UAV's measurement in this cycle
  std::vector<Vector3> places;  ///< of the UAVs that are measured
  std::vector<Turn> turns;      ///< of each UAV in this cycle
};

SwarmPlanner::SwarmPlanner(const Mission& mission, PlanningMode mode) : impl_(std::make_unique<Impl>(mission, mode)) {}
SwarmPlanner::~SwarmPlanner() = default;
SwarmPlanner::SwarmPlanner(SwarmPlanner&&) noexcept = default;
SwarmPlanner& SwarmPlanner::operator=(SwarmPlanner&&) noexcept = default;

std::size_t SwarmPlanner::uavCount() const { return impl_->uavs.size(); }
const std::string& SwarmPlanner::uavName(std::size_t uav) const { return impl_->uavs[uav].name; }

const CycleReport& SwarmPlanner::plan(const Snapshot& snapshot, double epoch, double budget) {
  impl_->plan(snapshot, epoch, budget);
  return impl_->report;
}

bool SwarmPlanner::searchGuides() { return impl_->searchGuides(); }

const CycleReport& SwarmPlanner::report() const { return impl_->report; }
const CommittedMotion& SwarmPlanner::committed(std::size_t uav) const { return impl_->uavs[uav].motions.newest(); }

TargetState SwarmPlanner::target(std::size_t uav, double t) const {
  const MovingTarget& reference = impl_->uavs[uav].reference;
  return reference.at(impl_->uavs[uav].reference_pending ? -kInfinity : t);
}

const MovingTarget& SwarmPlanner::reference(std::size_t uav) const { return impl_->uavs[uav].reference; }

const ReferencePath* SwarmPlanner::guide(std::size_t uav) const {
  const GuidedFlight& guide = impl_->uavs[uav].guide;
  return guide.active() ? &guide.path() : nullptr;
}

void SwarmPlanner::setReference(std::size_t uav, const std::vector<Vector3>& path, double start, double speed) {
  if (uav >= impl_->uavs.size()) throw std::invalid_argument("there is no UAV " + std::to_string(uav));
  requireReference(path, start, speed);
  impl_->uavs[uav].setReference(path, start, speed);
}

CommandAnswer SwarmPlanner::command(std::size_t uav, FlightCommand command) {
  if (uav >= impl_->uavs.size()) throw std::invalid_argument("there is no UAV " + std::to_string(uav));
  return impl_->command(uav, command);
}

FlightMode SwarmPlanner::mode(std::size_t uav) const { return impl_->uavs[uav].task.mode; }

void SwarmPlanner::setForeign(std::size_t uav, bool foreign) {
  command(uav, foreign ? FlightCommand::kLeave : FlightCommand::kJoin);
}

bool SwarmPlanner::isForeign(std::size_t uav) const { return impl_->uavs[uav].foreign; }
double SwarmPlanner::progress(std::size_t uav) const { return impl_->uavs[uav].progress; }

void SwarmPlanner::takeOver(const FlightMemory& memory) { impl_->takeOver(memory); }

void SwarmPlanner::restoreMode(std::size_t uav, FlightMode mode) { impl_->enter(uav, mode); }

void SwarmPlanner::reset() { impl_->reset(); }

}  // namespace swarm_planner
