// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/swarm_planner.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "swarm_planner/obstacles/track_memory.hpp"
#include "swarm_planner/sqp/linearisation.hpp"
#include "swarm_planner/swarm/solve_order.hpp"
#include "swarm_planner/swarm/stopwatch.hpp"
#include "swarm_planner/swarm/surroundings.hpp"
#include "swarm_planner/swarm/takeover.hpp"
#include "swarm_planner/swarm/thread_team.hpp"
#include "swarm_planner/swarm/uav_planner.hpp"

namespace swarm_planner {
namespace {

constexpr double kLargest = 1e8;  // metres or m/s that no UAV is at: an estimator has diverged
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Obstacles that there is room for before memory has to grow in flight: tracks may be more than the scenario has.
std::size_t maxObstacles(const Mission& mission) {
  constexpr std::size_t kTracks = 256;
  return std::max(kTracks, mission.scenario.obstacles.size());
}

std::vector<Vector3> homesOf(const Scenario& scenario) {
  std::vector<Vector3> homes;
  for (const ScenarioUav& uav : scenario.uavs) homes.push_back(uav.start);
  return homes;
}

/// False for NaN too.
bool isPlausible(const Vector3& x) { return (x.array().abs() < kLargest).all(); }

/// Why a measurement cannot be planned from; kNone if it can.
Reason judge(const UavMeasurement& measurement, double now, double timeout) {
  if (!measurement.received) return Reason::kWaitingForOdometry;
  if (!isPlausible(measurement.p) || !isPlausible(measurement.v) || !std::isfinite(measurement.stamp)) {
    return Reason::kOdometryNotFinite;
  }
  if (measurement.stamp > now + kClockTolerance) return Reason::kOdometryFromFuture;
  if (now - measurement.stamp > timeout) return Reason::kOdometryStale;
  return Reason::kNone;
}

}  // namespace

class SwarmPlanner::Impl {
 public:
  explicit Impl(const Mission& mission)
      : parameters(mission.parameters),
        uavs(mission.scenario.uavs.size()),
        tracks(parameters.input.track_timeout, maxObstacles(mission)),
        surroundings(parameters, uavs.size(), maxObstacles(mission)),
        takeover(homesOf(mission.scenario)),
        team(static_cast<std::size_t>(parameters.compute.threads)),
        judged(uavs.size()) {
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      const ScenarioUav& uav = mission.scenario.uavs[i];
      uavs[i].name = uav.name;
      uavs[i].beginning.home = uav.start;
      uavs[i].setReference(uav.reference, uav.target.start, uav.target.speed);
    }
    report.uavs.resize(uavs.size());
    order.reserve(uavs.size());
    const QpModels models = makeQpModels(parameters);
    const auto tables = std::make_shared<GeneratedTables>(std::vector<QpModel>{models.straight, models.corner});
    for (std::size_t member = 0; member < team.size(); ++member) {
      planners.emplace_back(parameters, mission.scenario.workspace, tables, uavs.size() + maxObstacles(mission));
    }
  }

  void reset() {
    report.started = false;
    planning = false;
    takeover.reset();
    tracks.reset();
    for (UavRecord& uav : uavs) uav.reset();
  }

  void takeOver(const FlightMemory& memory) {
    report.started = true;
    report.time_zero = memory.time_zero;
    double last_epoch = 0.0;
    for (const UavMemory& uav : memory.uavs) last_epoch = std::max(last_epoch, uav.epoch);
    takeover.reset(memory.obstacles, last_epoch);
    const std::size_t count = std::min(uavs.size(), memory.uavs.size());
    for (std::size_t i = 0; i < count; ++i) swarm_planner::takeOver(memory.uavs[i], uavs[i]);
  }

  void plan(const Snapshot& snapshot, double epoch, double budget) {
    const Stopwatch stopwatch;
    ++report.cycle;
    report.epoch = epoch;
    report.out_of_time = false;
    tracks.update(snapshot.obstacles, snapshot.now);
    report.refused_tracks = tracks.refused();
    judgeMeasurements(snapshot);
    observeBeginners(snapshot);
    if (!planning) start(snapshot, epoch);
    if (planning) planAll(snapshot, epoch, stopwatch, budget);
    report.cycle_time = stopwatch.elapsed();
  }

  const Parameters parameters;
  std::vector<UavRecord> uavs;
  CycleReport report;

 private:
  void judgeMeasurements(const Snapshot& snapshot) {
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      const UavMeasurement none;
      judged[i] =
          judge(i < snapshot.uavs.size() ? snapshot.uavs[i] : none, snapshot.now, parameters.input.odometry_timeout);
      UavReport& uav_report = report.uavs[i];
      uav_report = UavReport();
      uav_report.obstacle_clearance = uav_report.pair_distance = kInfinity;
      uav_report.state = report.started && judged[i] != Reason::kNone ? UavState::kLost : UavState::kHolding;
      uav_report.reason = judged[i];
      if (judged[i] == Reason::kNone && !report.started) {
        uav_report.reason = parameters.input.autostart ? Reason::kWaitingForOthers : Reason::kWaitingForStart;
      }
    }
  }

  void observeBeginners(const Snapshot& snapshot) {
    takeover.beginCycle(snapshot.now);
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if (judged[i] == Reason::kNone && uavs[i].beginning.pending) takeover.observe(i, snapshot.uavs[i]);
    }
  }

  /// Begins to plan if it is time to: on the ground when all odometry has arrived, in flight when the takeover is
  /// ready.
  void start(const Snapshot& snapshot, double epoch) {
    const bool in_flight = report.started || takeover.findsFlight();
    planning = in_flight ? takeover.isReady(tracks.tracks().size()) : allArrived(snapshot);
    planning = planning && (report.started || parameters.input.autostart);
    if (planning && !report.started) report.time_zero = epoch;
    report.started = report.started || planning;
    if (!in_flight || !(report.started || parameters.input.autostart)) return;
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      if (judged[i] != Reason::kNone) {
        report.uavs[i].state = UavState::kLost;
      } else if (!planning) {
        report.uavs[i].state = UavState::kFallback;
        report.uavs[i].reason = Reason::kTakingOver;
      }
    }
  }

  bool allArrived(const Snapshot& snapshot) const {
    return snapshot.uavs.size() == uavs.size() &&
           std::all_of(judged.begin(), judged.end(), [](Reason r) { return r == Reason::kNone; });
  }

  void planAll(const Snapshot& snapshot, double epoch, const Stopwatch& stopwatch, double budget) {
    surroundings.setEpoch(epoch);
    surroundings.setObstacles(tracks.tracks(), snapshot.now);
    team.forEach(0, uavs.size(), [&](std::size_t i, std::size_t) { prepare(i, snapshot, epoch); });
    surroundings.findNeighbours();
    order.build(surroundings.neighbours(), first);
    std::atomic<bool> planned{false};
    for (std::size_t round = 0; round < order.rounds(); ++round) {
      team.forEach(order.roundBegin(round), order.roundBegin(round + 1), [&](std::size_t position, std::size_t member) {
        const std::size_t i = order.uav(position);
        if (judged[i] != Reason::kNone) return;
        // Whatever the budget, somebody makes progress.
        if (planned.exchange(true) && stopwatch.elapsed() > budget) {
          goOn(i, epoch);
        } else {
          planners[member].plan(i, epoch, uavs[i], surroundings, report.uavs[i]);
        }
      });
    }
    noteOverrun();
  }

  /// Tells the surroundings what the UAV does until it has a new plan, and how far a new one can take it.
  void prepare(std::size_t i, const Snapshot& snapshot, double epoch) {
    UavRecord& uav = uavs[i];
    if (uav.reference_pending) uav.reference.time_zero = epoch;
    uav.reference_pending = false;
    const bool measured = judged[i] == Reason::kNone;
    if (measured && uav.beginning.pending) {
      // One that is seen later than the others is in flight, too, if they are.
      const ObservedFlight* flight = takeover.findsFlight() ? &takeover.flight(i) : nullptr;
      begin(snapshot.uavs[i], epoch, parameters, flight, uav);
    } else if (measured) {
      uav.predictStart(snapshot.uavs[i], epoch, parameters);
    }
    if (uav.motions.empty()) {
      surroundings.setUnknown(i);
    } else {
      surroundings.setMotions(i, uav.motions.newest(), uav.motions.older());
    }
    if (measured) surroundings.setPlanning(i, uav.start);
  }

  /// There is no time to plan for the UAV.
  void goOn(std::size_t i, double epoch) {
    uavs[i].motions.goOn(epoch);
    report.uavs[i].planned = uavs[i].planned;
    report.uavs[i].state = UavState::kFallback;
    report.uavs[i].reason = Reason::kOverrun;
  }

  /// Whose turn came first of those that missed it comes first in the next cycle, so that nobody misses it for ever.
  /// By turn, not by round: the first of a later round could be passed over again and again.
  void noteOverrun() {
    for (std::size_t turn = 0; turn < uavs.size() && !report.out_of_time; ++turn) {
      const std::size_t i = (first + turn) % uavs.size();
      if (report.uavs[i].reason != Reason::kOverrun) continue;
      report.out_of_time = true;
      first = i;
    }
  }

  TrackMemory tracks;
  Surroundings surroundings;
  Takeover takeover;
  bool planning = false;  ///< the first plans have been made
  SolveOrder order;
  ThreadTeam team;
  std::vector<UavPlanner> planners;  ///< one per member of the team
  std::size_t first = 0;             ///< the UAV that plans first
  std::vector<Reason> judged;        ///< of each UAV's measurement in this cycle
};

SwarmPlanner::SwarmPlanner(const Mission& mission) : impl_(std::make_unique<Impl>(mission)) {}
SwarmPlanner::~SwarmPlanner() = default;
SwarmPlanner::SwarmPlanner(SwarmPlanner&&) noexcept = default;
SwarmPlanner& SwarmPlanner::operator=(SwarmPlanner&&) noexcept = default;

std::size_t SwarmPlanner::uavCount() const { return impl_->uavs.size(); }
const std::string& SwarmPlanner::uavName(std::size_t uav) const { return impl_->uavs[uav].name; }

const CycleReport& SwarmPlanner::plan(const Snapshot& snapshot, double epoch, double budget) {
  impl_->plan(snapshot, epoch, budget);
  return impl_->report;
}

const CycleReport& SwarmPlanner::report() const { return impl_->report; }
const CommittedMotion& SwarmPlanner::committed(std::size_t uav) const { return impl_->uavs[uav].motions.newest(); }

TargetState SwarmPlanner::target(std::size_t uav, double t) const {
  const MovingTarget& reference = impl_->uavs[uav].reference;
  return reference.at(impl_->uavs[uav].reference_pending ? -kInfinity : t);
}

const MovingTarget& SwarmPlanner::reference(std::size_t uav) const { return impl_->uavs[uav].reference; }

void SwarmPlanner::setReference(std::size_t uav, const std::vector<Vector3>& path, double start, double speed) {
  if (uav >= impl_->uavs.size()) throw std::invalid_argument("there is no UAV " + std::to_string(uav));
  if (path.empty()) throw std::invalid_argument("the path has no point");
  if (!std::all_of(path.begin(), path.end(), [](const Vector3& point) { return point.allFinite(); })) {
    throw std::invalid_argument("the path has a point that is not finite");
  }
  if (!(start >= 0.0) || !std::isfinite(start)) throw std::invalid_argument("start must be finite and >= 0");
  if (!(speed >= 0.0) || !std::isfinite(speed)) throw std::invalid_argument("speed must be finite and >= 0");
  impl_->uavs[uav].setReference(path, start, speed);
}

double SwarmPlanner::progress(std::size_t uav) const { return impl_->uavs[uav].progress; }

void SwarmPlanner::takeOver(const FlightMemory& memory) { impl_->takeOver(memory); }

void SwarmPlanner::reset() { impl_->reset(); }

}  // namespace swarm_planner
