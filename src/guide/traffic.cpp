// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/traffic.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kPrice = 2.0;       // of a metre within another's ellipsoid [m]
constexpr double kSampleStep = 0.5;  // of the shorter semi-axis, between two looks
constexpr int kMostSamples = 24;     // along one straight flight

}  // namespace

Vector3 PlannedFlight::at(double t, double spacing) const {
  const double index = std::clamp(t / spacing, 0.0, static_cast<double>(kPoints - 1));
  const auto before = std::min(static_cast<std::size_t>(index), kPoints - 2);
  return points[before] + (index - static_cast<double>(before)) * (points[before + 1] - points[before]);
}

Traffic::Traffic(double horizontal, double vertical, std::size_t capacity)
    : horizontal_(horizontal), vertical_(vertical) {
  flights_.reserve(capacity);
}

void Traffic::add(const PlannedFlight& flight) {
  if (flights_.size() < flights_.capacity()) flights_.push_back(&flight);
}

double Traffic::cost(const TimedPoint& from, const TimedPoint& to) const {
  if (flights_.empty()) return 0.0;
  const double length = (to.p - from.p).norm();
  const double step = kSampleStep * std::min(horizontal_, vertical_);
  const int samples = std::clamp(static_cast<int>(std::ceil(length / step)), 1, kMostSamples);
  Box way;
  way.include(from.p);
  way.include(to.p);
  const Vector3 scale(1.0 / horizontal_, 1.0 / horizontal_, 1.0 / vertical_);
  int within = 0;
  for (const PlannedFlight* flight : flights_) {
    if (!flight->box.near(way, std::max(horizontal_, vertical_))) continue;
    for (int i = 0; i < samples; ++i) {
      const double share = (i + 0.5) / samples;
      const Vector3 p = from.p + share * (to.p - from.p);
      const Vector3 other = flight->at(from.t + share * (to.t - from.t), spacing_);
      if ((p - other).cwiseProduct(scale).squaredNorm() < 1.0) ++within;
    }
  }
  return kPrice * length * within / samples;
}

}  // namespace swarm_planner
