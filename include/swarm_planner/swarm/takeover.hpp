// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/swarm/cycle_report.hpp"
#include "swarm_planner/swarm/flight_memory.hpp"
#include "swarm_planner/swarm/motion_memory.hpp"
#include "swarm_planner/swarm/snapshot.hpp"

namespace swarm_planner {

/// A UAV in flight of which no motion is known, as odometry shows it: the newest three measurements give the
/// acceleration that odometry lacks. Takes no heap.
class ObservedFlight {
 public:
  static constexpr double kLongestGap = 1.0;  ///< [s]

  void clear() { count_ = 0; }
  /// One that is not newer than the last is ignored; after a gap of more than kLongestGap the older ones are forgotten.
  void add(const UavMeasurement& measurement);
  std::size_t count() const { return count_; }
  /// State and jerk at the newest measurement, from the parabola through the velocities (fewer than three: no
  /// acceleration), within what a UAV is able to do. Not if nothing was measured.
  KinematicState state(const LimitParameters& limits) const;
  Vector3 jerk(const LimitParameters& limits) const;
  const UavMeasurement& newest() const { return samples_[count_ - 1]; }
  double stamp() const { return newest().stamp; }

 private:
  std::array<UavMeasurement, 3> samples_;  ///< the oldest first
  std::size_t count_ = 0;
};

struct UavRecord;

/// How a UAV comes to be planned for: from its scenario's start, or in flight.
struct Beginning {
  Vector3 home = Vector3::Zero();  ///< where the scenario has it start [m]
  bool pending = true;             ///< no measurement of it has been planned from yet
  bool is_left = false;            ///< its motions, and what follows, come from a planner before, not confirmed yet
  bool on_reference = false;       ///< progress and target are those of the reference that holds
  double progress = 0.0;           ///< as in UavMemory
  double target = 0.0;
  double epoch = 0.0;

  void reset() {
    pending = true;
    is_left = false;
    on_reference = false;
  }
};

/// Gives the record the motions that a planner before has left, if any. They count until odometry says otherwise.
void takeOver(const UavMemory& left, UavRecord& record);

/// UavRecord::predictStart for a UAV whose beginning is pending. What a planner before has left holds if `measurement`
/// agrees with it. Otherwise a UAV in flight (`observed` not null) is taken to brake, and any other to hover. The
/// target then goes on where the UAV is (doc/safety.md, "When the planner is replaced").
void begin(const UavMeasurement& measurement, double epoch, const Parameters& parameters, const FlightBounds& bounds,
           const ObservedFlight* observed, UavRecord& record);

/// Leaves in `motions` what a UAV in flight is taken to do: as observed until `epoch` [s], then it brakes.
void assumeBraking(const ObservedFlight& flight, double epoch, const Parameters& parameters, MotionMemory& motions);

/// When a planner that finds UAVs in flight begins. What they fly has been checked to its end, where they rest: it is
/// safe to wait as long as all fly it, and it is not to plan before the obstacles are known.
class Takeover {
 public:
  /// Slower counts as hovering [m/s]: noise, a gust.
  static constexpr double kHovering = 0.5;
  /// A UAV so close to its scenario's start has not left yet [m].
  static constexpr double kAtHome = 1.0;
  /// Longest wait, from the first cycle on [s].
  static constexpr double kPatience = 2.0;
  /// A UAV that flies into one that hovers within this time is not waited for [s]: so long a stop and the cycle before
  /// it take.
  static constexpr double kUrgent = 1.5;

  /// `homes`: where the scenario has each UAV start [m].
  Takeover(const std::vector<Vector3>& homes, const LimitParameters& limits)
      : limits_(limits), homes_(homes), flights_(homes.size()) {}

  /// Forgets everything. `obstacles`: so many tracks were in use before; empty: not known.
  /// `epoch`: of the last plans before [s]; only later measurements tell whether a vehicle flies them.
  void reset(std::optional<std::size_t> obstacles = {}, double epoch = 0.0);
  /// A cycle begins at `now` [s].
  void beginCycle(double now);
  /// A usable measurement of a UAV that has not been planned for yet.
  void observe(std::size_t uav, const UavMeasurement& measurement);

  /// Some UAV is in flight of which no motion is known: it moves, or is not where it would start.
  bool findsFlight() const { return finds_flight_; }
  /// With a known number of obstacles as soon as there are as many `tracks`; else, and at the latest, after kPatience,
  /// in which UAVs are observed. Without a record at once if one of them flies into one that hovers, which may have
  /// stopped on its own.
  bool isReady(std::size_t tracks) const;
  const ObservedFlight& flight(std::size_t uav) const { return flights_[uav]; }

 private:
  /// Whether a UAV at its velocity comes closer than pairs may to one that hovers within kUrgent.
  bool foreseesEncounter() const;

  const LimitParameters limits_;
  const std::vector<Vector3> homes_;
  std::vector<ObservedFlight> flights_;
  std::optional<std::size_t> obstacles_;
  double last_epoch_ = 0.0;      ///< of the planner before [s]
  std::optional<double> begin_;  ///< of the first cycle [s]
  double now_ = 0.0;             ///< [s]
  bool finds_flight_ = false;
};

}  // namespace swarm_planner
