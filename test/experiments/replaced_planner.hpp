// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "swarm_planner/experiments/closed_loop_run.hpp"

namespace swarm_planner {

/// How a planner dies and is replaced. Times since t = 0 of the run [s].
struct Replacement {
  double death = 0.0;
  double gap = 0.0;            ///< until another one runs
  bool memory = true;          ///< it has what the first one left
  bool newest_unsent = false;  ///< death came between keeping the last plans and sending them
  double blind = 0.0;          ///< so long the new one hears of no obstacle
};

/// A planner that is replaced in flight: vehicles hear nothing in between.
class ReplacedPlanner : public CyclePlanner {
 public:
  ReplacedPlanner(const Mission& mission, const Replacement& replacement)
      : mission_(mission), replacement_(replacement), planner_(std::make_unique<SwarmPlanner>(mission)) {
    silence_.uavs.resize(planner_->uavCount());
  }

  const CycleReport& plan(const Snapshot& snapshot, double epoch) override {
    if (planner_ && !replaced_ && epoch >= replacement_.death) {
      if (replacement_.newest_unsent) {
        planner_->plan(snapshot, epoch);
        remember(*planner_, snapshot.obstacles.size(), memory_);
      }
      planner_.reset();
    }
    if (!planner_ && epoch < replacement_.death + replacement_.gap) return silence_;
    if (!planner_) replace(epoch);
    Snapshot seen = snapshot;
    if (replaced_ && epoch < *replaced_ + replacement_.blind) seen.obstacles.clear();
    planner_->plan(seen, epoch);
    remember(*planner_, snapshot.obstacles.size(), memory_);
    noteReturn(epoch);
    return planner_->report();
  }
  const CommittedMotion& committed(std::size_t uav) const override { return planner_->committed(uav); }
  const SwarmPlanner& planner() const { return *planner_; }

  /// Epoch of the new planner's first cycle; of the first in which it planned for every UAV.
  std::optional<double> replaced() const { return replaced_; }
  std::optional<double> returned() const { return returned_; }
  bool alarmed() const { return alarmed_; }

 private:
  void replace(double epoch) {
    planner_ = std::make_unique<SwarmPlanner>(mission_);
    if (replacement_.memory) planner_->takeOver(memory_);
    replaced_ = epoch;
  }

  void noteReturn(double epoch) {
    if (!replaced_) return;
    const std::vector<UavReport>& uavs = planner_->report().uavs;
    if (std::any_of(uavs.begin(), uavs.end(), [](const UavReport& uav) { return isAlarm(uav.reason); }))
      alarmed_ = true;
    if (returned_) return;
    if (std::all_of(uavs.begin(), uavs.end(), [](const UavReport& uav) { return uav.state == UavState::kTracking; })) {
      returned_ = epoch;
    }
  }

  const Mission& mission_;
  const Replacement replacement_;
  std::unique_ptr<SwarmPlanner> planner_;
  FlightMemory memory_;
  CycleReport silence_;
  std::optional<double> replaced_;
  std::optional<double> returned_;
  bool alarmed_ = false;
};

/// The largest jumps of the vehicles' setpoints from one sample to the next, beyond what the motion itself makes.
class JumpWatch : public RunObserver {
 public:
  explicit JumpWatch(std::size_t uavs) : last_(uavs) {}
  void onSample(double t, const std::vector<QuadSimulator>& vehicles, const std::vector<Superellipsoid>&) override {
    const double dt = t - time_;
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      const MotionSetpoint now = vehicles[i].setpoint();
      const MotionSetpoint& last = last_[i];
      if (t > from_ && t <= until_) {
        p_ = std::max(p_, (now.p - last.p - 0.5 * dt * (now.v + last.v)).norm());
        v_ = std::max(v_, (now.v - last.v - 0.5 * dt * (now.a + last.a)).norm());
        a_ = std::max(a_, (now.a - last.a).norm());
        off_ = std::max(off_, (now.p - vehicles[i].state().p).norm());
      }
      last_[i] = now;
    }
    time_ = t;
  }
  void onCycle(double, const CycleReport&) override {}
  /// Looks at jumps between these times alone [s].
  void lookAt(double from, double until) {
    from_ = from;
    until_ = until;
  }
  double p() const { return p_; }      ///< [m]
  double v() const { return v_; }      ///< [m/s]
  double a() const { return a_; }      ///< [m/s^2]
  double off() const { return off_; }  ///< of a vehicle from its setpoint [m]

 private:
  std::vector<MotionSetpoint> last_;
  double time_ = 0.0;
  double from_ = 0.0;
  double until_ = 0.0;
  double p_ = 0.0;
  double v_ = 0.0;
  double a_ = 0.0;
  double off_ = 0.0;
};

}  // namespace swarm_planner
