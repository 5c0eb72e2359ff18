// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace swarm_planner {

/// The instants at which a sensor of a closed loop measures.
///
/// They lie 1 / rate apart, counted back from each planning cycle, n cycle_period for n = ..., -1, 0, 1, ...; all of
/// them are `latency` earlier. So the newest message that reaches a cycle, if it is neither lost nor delayed further,
/// is exactly `latency` old, and how many are sent depends on nothing but the rate. That is a whole number per cycle:
/// rounded down, but at least one.
class SensorClock {
 public:
  /// Begins so early that measurements of at least kWarmUp have reached the cycle at -cycle_period.
  SensorClock(double rate, double cycle_period, double latency);

  static constexpr double kWarmUp = 1.0;  ///< [s]

  /// The next instant at which to measure [s].
  double next() const;
  /// It has been done.
  void advance() { ++count_; }

 private:
  double rate_, period_, latency_;
  long long per_cycle_;
  long long first_cycle_;
  long long count_ = 0;  ///< measurements so far
};

}  // namespace swarm_planner
