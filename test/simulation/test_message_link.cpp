// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, an experiment with late or lost messages is not the one that its options describe, or cannot be
// repeated.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "swarm_planner/simulation/message_link.hpp"

namespace swarm_planner {
namespace {

constexpr double kPeriod = 0.02;  // of sending [s]
constexpr int kCount = 20000;

SimulationParameters settings(double latency, double jitter, double drop) {
  SimulationParameters simulation;
  simulation.latency = latency;
  simulation.jitter = jitter;
  simulation.drop = drop;
  return simulation;
}

double sentAt(int number) { return kPeriod * number; }

/// Sends kCount messages that carry their number; their arrivals, in the order in which they were delivered.
std::vector<std::pair<int, double>> deliveries(const SimulationParameters& simulation, std::uint64_t seed) {
  MessageLink<int> link(simulation, seed);
  std::vector<std::pair<int, double>> delivered;
  const auto receive = [&delivered](double arrival, int number) { delivered.emplace_back(number, arrival); };
  for (int i = 0; i < kCount; ++i) {
    link.deliver(sentAt(i) - 0.5 * kPeriod, receive);
    link.send(sentAt(i), i);
  }
  link.deliver(1e9, receive);
  return delivered;
}

/// Arrivals of messages so far apart that none overtakes another.
std::map<int, double> delays(const SimulationParameters& simulation, std::uint64_t seed) {
  LinkDelay delay(simulation, seed);
  std::map<int, double> delays;
  for (int i = 0; i < kCount; ++i) {
    if (const std::optional<double> arrival = delay.arrival(100.0)) delays[i] = *arrival - 100.0;
  }
  return delays;
}

TEST(MessageLink, WithoutDisturbanceAMessageArrivesAsItIsSent) {
  MessageLink<int> link(settings(0.0, 0.0, 0.0), 1);
  for (int i = 0; i < 10; ++i) {
    link.send(sentAt(i), i);
    int received = -1;
    link.deliver(sentAt(i), [&](double arrival, int number) {
      EXPECT_EQ(arrival, sentAt(i));
      received = number;
    });
    EXPECT_EQ(received, i);
  }
}

TEST(MessageLink, LatencyIsExactAndKeepsTheOrder) {
  MessageLink<int> link(settings(0.123, 0.0, 0.0), 1);
  link.send(1.0, 1);
  link.send(1.05, 2);
  std::vector<int> received;
  const auto receive = [&received](double, int number) { received.push_back(number); };
  link.deliver(1.1229, receive);
  EXPECT_EQ(received, std::vector<int>{});
  link.deliver(1.123, receive);
  EXPECT_EQ(received, std::vector<int>{1});
  link.deliver(2.0, receive);
  EXPECT_EQ(received, (std::vector<int>{1, 2}));
  link.deliver(3.0, receive);
  EXPECT_EQ(received.size(), 2u);
}

TEST(MessageLink, TheReceiverKeepsTheNewestOfThoseThatOvertakeEachOther) {
  constexpr double kLatency = 0.1, kJitter = 0.1;
  const auto delivered = deliveries(settings(kLatency, kJitter, 0.0), 3);
  EXPECT_LT(delivered.size(), 0.9 * kCount);  // some were overtaken
  EXPECT_GT(delivered.size(), 0.2 * kCount);
  for (std::size_t i = 0; i < delivered.size(); ++i) {
    const auto [number, arrival] = delivered[i];
    ASSERT_GE(arrival - sentAt(number), kLatency - 1e-9);
    ASSERT_LT(arrival - sentAt(number), kLatency + kJitter + 1e-9);
    if (i == 0) continue;
    ASSERT_GT(number, delivered[i - 1].first);
    ASSERT_GE(arrival, delivered[i - 1].second);
  }
}

TEST(MessageLink, JitterIsUniform) {
  const auto delay = delays(settings(0.2, 0.3, 0.0), 5);
  ASSERT_EQ(delay.size(), static_cast<std::size_t>(kCount));
  double mean = 0.0, square = 0.0;
  int lower_quarter = 0;
  for (const auto& [number, value] : delay) {
    ASSERT_GE(value, 0.2 - 1e-9);
    ASSERT_LE(value, 0.5 + 1e-9);
    mean += (value - 0.35) / kCount;
    square += (value - 0.35) * (value - 0.35) / kCount;
    lower_quarter += value < 0.275 ? 1 : 0;
  }
  const double sigma = 0.3 / std::sqrt(12.0);
  EXPECT_NEAR(mean, 0.0, 4.0 * sigma / std::sqrt(kCount));
  EXPECT_NEAR(square, sigma * sigma, 4.0 * sigma * sigma * std::sqrt(0.8 / kCount));
  EXPECT_NEAR(lower_quarter, 0.25 * kCount, 4.0 * std::sqrt(0.25 * 0.75 * kCount));
}

TEST(MessageLink, AsManyMessagesAreLostAsTheProbabilitySays) {
  for (const double drop : {0.05, 0.2, 0.5}) {
    const auto arrived = static_cast<double>(deliveries(settings(0.1, 0.0, drop), 7).size());
    EXPECT_NEAR(arrived, (1.0 - drop) * kCount, 4.0 * std::sqrt(drop * (1.0 - drop) * kCount)) << drop;
  }
  EXPECT_EQ(deliveries(settings(0.1, 0.0, 0.0), 7).size(), static_cast<std::size_t>(kCount));
  EXPECT_TRUE(deliveries(settings(0.1, 0.0, 1.0), 7).empty());
}

TEST(MessageLink, LossesComeOneByOne) {
  const auto delivered = deliveries(settings(0.0, 0.0, 0.3), 11);
  int pairs = 0;
  for (std::size_t i = 1; i < delivered.size(); ++i) pairs += delivered[i].first == delivered[i - 1].first + 1 ? 1 : 0;
  EXPECT_NEAR(pairs, 0.49 * kCount, 4.0 * std::sqrt(0.5 * kCount));
}

TEST(MessageLink, TheSeedDecides) {
  const SimulationParameters simulation = settings(0.1, 0.05, 0.2);
  EXPECT_EQ(deliveries(simulation, 1), deliveries(simulation, 1));
  EXPECT_NE(deliveries(simulation, 1), deliveries(simulation, 2));
}

TEST(MessageLink, LossesLeaveTheDelaysOfTheOthersAlone) {
  const auto all = delays(settings(0.1, 0.05, 0.0), 9);
  const auto some = delays(settings(0.1, 0.05, 0.4), 9);
  const auto no_jitter = delays(settings(0.1, 0.0, 0.4), 9);
  ASSERT_LT(some.size(), all.size());
  ASSERT_EQ(some.size(), no_jitter.size());
  for (const auto& [number, delay] : some) {
    ASSERT_EQ(delay, all.at(number));
    ASSERT_EQ(no_jitter.count(number), 1u);
  }
}

TEST(MessageLink, WhatIsUnderWayCanBeLost) {
  MessageLink<int> link(settings(0.5, 0.0, 0.0), 1);
  link.send(0.0, 1);
  link.clear();
  link.send(0.1, 2);
  std::vector<int> received;
  link.deliver(10.0, [&received](double, int number) { received.push_back(number); });
  EXPECT_EQ(received, std::vector<int>{2});
}

}  // namespace
}  // namespace swarm_planner
