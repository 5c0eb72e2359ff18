// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace swarm_planner {
namespace {

/// `sorted` must not be empty.
double quantile(const std::vector<double>& sorted, double q) {
  const double rank = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(rank));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

void Histogram::add(double sample) {
  // A sample of 0, and one that is not a number, too.
  const double bin = sample > kLeast ? std::floor(kBinsPerDecade * std::log10(sample / kLeast)) : 0.0;
  ++counts[static_cast<std::size_t>(std::min(bin, static_cast<double>(counts.size() - 1)))];
}

Histogram histogramOf(const std::vector<double>& samples) {
  Histogram histogram;
  for (const double sample : samples) histogram.add(sample);
  return histogram;
}

Distribution distributionOf(std::vector<double> samples) {
  Distribution distribution;
  if (samples.empty()) return distribution;
  std::sort(samples.begin(), samples.end());
  distribution.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
  distribution.median = quantile(samples, 0.5);
  distribution.p99 = quantile(samples, 0.99);
  distribution.max = samples.back();
  return distribution;
}

}  // namespace swarm_planner
