// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, the planner of a closed-loop run sees odometry of another age than the options say.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "swarm_planner/simulation/sensor_clock.hpp"

namespace swarm_planner {
namespace {

TEST(SensorClock, MeasuresAtItsRateAndAtEveryCycle) {
  SensorClock clock(50.0, 0.3, 0.0);
  double last = clock.next();
  EXPECT_LE(last, -0.3 - SensorClock::kWarmUp);
  for (int i = 0; i < 1000; ++i) {
    clock.advance();
    EXPECT_NEAR(clock.next() - last, 0.02, 1e-9);
    last = clock.next();
  }
  SensorClock again(50.0, 0.3, 0.0);
  while (again.next() < -1e-9) again.advance();
  EXPECT_DOUBLE_EQ(again.next(), 0.0);
}

TEST(SensorClock, EveryCycleGetsAMessageOfExactlyTheLatency) {
  for (const double period : {0.15, 0.25, 0.3, 0.125}) {
    for (const double rate : {1.0, 10.0, 50.0, 33.0}) {
      SensorClock clock(rate, period, 0.123);
      double newest = -1e9;
      double least = 1e9;
      for (int cycle = -1; cycle < 100; ++cycle) {
        const double now = cycle * period;
        for (; clock.next() + 0.123 <= now + 1e-9; clock.advance()) {
          if (newest > -1e8) least = std::min(least, clock.next() - newest);
          newest = clock.next();
        }
        EXPECT_NEAR(now - newest, 0.123, 1e-9);
      }
      EXPECT_GT(least, std::min(1.0 / rate, period) - 1e-9) << "period " << period << " rate " << rate;
    }
  }
}

TEST(SensorClock, LatencyShiftsTheMeasurementsAndChangesNothingElse) {
  SensorClock clock(50.0, 0.25, 0.0), late(50.0, 0.25, 0.3);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_NEAR(late.next(), clock.next() - 0.3, 1e-9);
    clock.advance();
    late.advance();
  }
}

}  // namespace
}  // namespace swarm_planner
