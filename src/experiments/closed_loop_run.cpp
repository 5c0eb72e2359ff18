// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/closed_loop_run.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "swarm_planner/experiments/kkt_nonzeros.hpp"
#include "swarm_planner/experiments/negative_controls.hpp"

namespace swarm_planner {
namespace {

constexpr double kSecondsToMilliseconds = 1000.0;
constexpr double kSameInstant = 1e-9;  // [s]

MeanMax meanMax(const std::vector<double>& samples) {
  const Distribution distribution = distributionOf(samples);
  return {distribution.mean, distribution.max};
}

/// Room for `count` samples in memory that is in use from now on: that of a long run does not grow under way.
void setAside(std::vector<double>& samples, std::size_t count) {
  samples.assign(count, 0.0);
  samples.clear();
}

}  // namespace

ClosedLoopRun::ClosedLoopRun(const Mission& mission, CyclePlanner& planner, std::uint64_t seed)
    : mission_(mission),
      planner_(planner),
      time_(-std::numeric_limits<double>::infinity()),
      odometry_clock_(mission.parameters.simulation.odometry_rate, mission.parameters.time.cycle_period,
                      mission.parameters.simulation.latency),
      track_clock_(mission.parameters.simulation.track_rate, mission.parameters.time.cycle_period,
                   mission.parameters.simulation.latency),
      track_link_(mission.parameters.simulation, streamSeed(seed, RandomUse::kTrackLink)),
      monitor_(mission),
      faults_(mission, seed),
      records_(streamSeed(seed, RandomUse::kFlightRecord)) {
  const Scenario& scenario = mission.scenario;
  const SimulationParameters& simulation = mission.parameters.simulation;
  for (std::size_t i = 0; i < scenario.uavs.size(); ++i) {
    vehicles_.emplace_back(mission.parameters, scenario.uavs[i].start, seed, i);
    externals_.emplace_back();
    if (scenario.uavs[i].external) externals_.back().emplace(scenario.uavs[i]);
    odometry_links_.emplace_back(simulation, streamSeed(seed, RandomUse::kOdometryLink, i));
    setpoint_links_.emplace_back(simulation, streamSeed(seed, RandomUse::kSetpointLink, i));
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) obstacles_at_start_.push_back(makeObstacle(obstacle));
  obstacles_ = obstacles_at_start_;
  samples_.resize(vehicles_.size());
  snapshot_.uavs.resize(vehicles_.size());
  snapshot_.map = mission.map;
  result_.scenario = scenario.name;
  result_.seed = seed;
  result_.uavs = vehicles_.size();
  result_.simulation = simulation;
  result_.as_paper = mission.parameters.limits.as_paper;
  result_.left_out = leftOut(mission.parameters.limits);
  result_.kkt_nonzeros = kktNonzeros(mission);
  faults_.scheduleScenario(0.0);
  if (!scenario.end.duration) return;
  const auto cycles = static_cast<std::size_t>(*scenario.end.duration / mission.parameters.time.cycle_period) + 2;
  setAside(cycle_ms_, cycles);
  setAside(cycle_cpu_ms_, cycles);
  for (std::vector<double>* samples : {&uav_ms_, &sqp_iterations_, &qp_iterations_}) {
    setAside(*samples, cycles * vehicles_.size());
  }
}

RunResult ClosedLoopRun::fly(const std::vector<RunObserver*>& observers) {
  const double period = mission_.parameters.time.cycle_period;
  const int sendings = 1 + mission_.parameters.input.setpoint_repeats;
  // The first of each cycle follows on planning; cycle -1 plans from t = 0 on. To the paper planning takes no time.
  const int lead = mission_.parameters.limits.as_paper ? 0 : 1;
  long long sending = -lead * sendings;
  long long evaluation = 0;
  while (!monitor_.ended()) {
    // Both from counters: a sum of periods would drift.
    const double sending_time = static_cast<double>(sending) * period / sendings;
    const double evaluation_time = static_cast<double>(evaluation) * kEvaluationPeriod;
    measureBefore(std::min(sending_time, evaluation_time) - kSameInstant);
    if (sending_time < evaluation_time - kSameInstant) {
      if (sending % sendings == 0) {
        planCycle(sending_time, static_cast<double>(sending / sendings + lead) * period, observers);
      } else {
        moveTo(sending_time);
      }
      sendSetpoints(sending_time);
      ++sending;
    } else {
      evaluate(evaluation_time, observers);
      ++evaluation;
    }
  }
  summarise();
  return result_;
}

void ClosedLoopRun::moveTo(double t) {
  faults_.advanceTo(t);
  const bool standing = t <= -mission_.parameters.time.cycle_period;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    if (standing) {
      vehicles_[i].resetClock(t);
    } else {
      receiveSetpoints(i, t);
      vehicles_[i].advanceTo(t);
      faults_.disturb(i, vehicles_[i]);
    }
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    obstacles_[i] = obstacles_at_start_[i].movedBy(obstacleTime(i, t));
  }
  time_ = t;
}

double ClosedLoopRun::obstacleTime(std::size_t index, double t) const {
  return director_ != nullptr ? director_->obstacleTime(index, t) : t;
}

void ClosedLoopRun::measureBefore(double t) {
  for (;;) {
    const double next = std::min(odometry_clock_.next(), track_clock_.next());
    if (next >= t) return;
    // An instant that only rounding sets apart from the present one is the present one.
    if (next > time_ + kSameInstant) moveTo(next);
    if (odometry_clock_.next() <= next) {
      sendOdometry(next);
      odometry_clock_.advance();
    }
    if (track_clock_.next() <= next) {
      if (faults_.tracksArrive()) sendTracks(next);
      track_clock_.advance();
    }
  }
}

void ClosedLoopRun::sendOdometry(double now) {
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    UavMeasurement measurement = vehicles_[i].measure();
    QuadState state = vehicles_[i].state();
    if (faults_.spoilOdometry(i, measurement, state)) odometry_links_[i].send(now, measurement);
  }
}

void ClosedLoopRun::sendTracks(double now) {
  std::vector<TrackedObstacle> tracks;
  tracks.reserve(obstacles_.size());
  for (const Superellipsoid& obstacle : obstacles_) {
    if (faults_.trackIsSeen()) tracks.push_back({obstacle, time_});
  }
  track_link_.send(now, std::move(tracks));
}

void ClosedLoopRun::receiveMeasurements(double now) {
  for (std::size_t i = 0; i < odometry_links_.size(); ++i) {
    odometry_links_[i].deliver(
        now, [this, i](double, const UavMeasurement& measurement) { snapshot_.uavs[i] = measurement; });
  }
  track_link_.deliver(now, [this](double, const std::vector<TrackedObstacle>& tracks) {
    for (const TrackedObstacle& track : tracks) receiveTrack(track);
  });
}

/// Of each obstacle the newest: a message need not hold all of them.
void ClosedLoopRun::receiveTrack(const TrackedObstacle& track) {
  std::vector<TrackedObstacle>& known = snapshot_.obstacles;
  const auto same = std::find_if(known.begin(), known.end(),
                                 [&track](const TrackedObstacle& x) { return x.shape.id() == track.shape.id(); });
  if (same != known.end()) {
    *same = track;
  } else {
    known.push_back(track);
  }
}

void ClosedLoopRun::planCycle(double now, double epoch, const std::vector<RunObserver*>& observers) {
  moveTo(now);
  measureBefore(now + kSameInstant);
  receiveMeasurements(now);
  if (!faults_.plannerLives()) {
    report_ = nullptr;
    restart_due_ = true;
    return;
  }
  // Of every other planner that dies the record is lost too, at random.
  if (restart_due_) planner_.restart(records_.nextUniform() < 0.5);
  if (director_ != nullptr) director_->beforeCycle(now, vehicles_, restart_due_);
  restart_due_ = false;
  snapshot_.now = now;
  report_ = &planner_.plan(snapshot_, epoch);
  record(*report_);
  for (RunObserver* observer : observers) observer->onCycle(epoch, *report_);
}

void ClosedLoopRun::sendSetpoints(double now) {
  if (report_ == nullptr) return;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    if (externals_[i]) vehicles_[i].receive(externals_[i]->setpoints(now, 0.0));
    if (!report_->uavs[i].planned) continue;
    const CommittedMotion& motion = planner_.committed(i);
    sampleMotion(motion, motion.epoch(), kSetpointPeriod, std::numeric_limits<double>::infinity(), 0.0, setpoints_);
    setpoint_links_[i].send(now, setpoints_);
    receiveSetpoints(i, now);
  }
}

void ClosedLoopRun::receiveSetpoints(std::size_t uav, double now) {
  setpoint_links_[uav].deliver(now, [this, uav](double arrival, const SetpointTrajectory& setpoints) {
    vehicles_[uav].advanceTo(arrival);
    if (!faults_.setpointsReach(uav)) return;
    if (!vehicles_[uav].receive(setpoints)) ++result_.fallbacks["the vehicle refused the trajectory"];
  });
}

void ClosedLoopRun::record(const CycleReport& report) {
  ++result_.cycles;
  cycle_ms_.push_back(kSecondsToMilliseconds * report.cycle_time);
  cycle_cpu_ms_.push_back(kSecondsToMilliseconds * planner_.processorTime());
  if (report.cycle_time > mission_.parameters.time.cycle_period) ++result_.deadline_misses;
  for (const UavReport& uav : report.uavs) {
    if (uav.reason != Reason::kNone && !isCommanded(uav.reason) && !isTraffic(uav.reason))
      ++result_.fallbacks[reasonText(uav.reason)];
    if (uav.stops_early) ++result_.plans_stopped_early;
    if (uav.refusal != CheckReason::kAccepted) {
      ++result_.rejected_plans;
      ++result_.refusals[checkReasonText(uav.refusal)];
    }
    if (uav.sqp_iterations == 0) continue;  // nothing was solved for it
    uav_ms_.push_back(kSecondsToMilliseconds * uav.solve_time);
    sqp_iterations_.push_back(uav.sqp_iterations);
    qp_iterations_.push_back(uav.qp_iterations);
  }
}

void ClosedLoopRun::evaluate(double t, const std::vector<RunObserver*>& observers) {
  moveTo(t);
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const MotionSetpoint setpoint = vehicles_[i].setpoint();
    samples_[i].p = vehicles_[i].state().p;
    samples_[i].v = vehicles_[i].state().v;
    samples_[i].tracking_error = (setpoint.p - samples_[i].p).norm();
    samples_[i].jerk = setpoint.jerk;
  }
  monitor_.observe(t, samples_, obstacles_);
  for (RunObserver* observer : observers) observer->onSample(t, vehicles_, obstacles_);
}

void ClosedLoopRun::summarise() {
  result_.cycle_ms = distributionOf(cycle_ms_);
  result_.uav_ms = distributionOf(uav_ms_);
  result_.cycle_cpu_ms = distributionOf(cycle_cpu_ms_);
  result_.cycle_ms_histogram = histogramOf(cycle_ms_);
  result_.uav_ms_histogram = histogramOf(uav_ms_);
  result_.sqp_iterations = meanMax(sqp_iterations_);
  result_.qp_iterations = meanMax(qp_iterations_);
  result_.flown = monitor_.summary();
}

}  // namespace swarm_planner
