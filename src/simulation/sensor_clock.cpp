// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/sensor_clock.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kRounding = 1e-9;  // a whole number of periods must not become one less

}  // namespace

SensorClock::SensorClock(double rate, double cycle_period, double latency)
    : rate_(rate),
      period_(cycle_period),
      latency_(latency),
      per_cycle_(std::max<long long>(1, std::llround(std::floor(rate * cycle_period + kRounding)))),
      first_cycle_(-1 - std::llround(std::ceil(kWarmUp / cycle_period))) {}

double SensorClock::next() const {
  const double cycle = static_cast<double>(first_cycle_ + count_ / per_cycle_) * period_;
  const auto before_cycle = static_cast<double>(per_cycle_ - 1 - count_ % per_cycle_);
  return cycle - before_cycle / rate_ - latency_;
}

}  // namespace swarm_planner
