// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

namespace swarm_planner {

/// What is reported of a measured quantity; all 0 if nothing was measured.
struct Distribution {
  double mean = 0.0;
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// Summary of `samples` (taken by value: it is sorted). Median and 99th percentile by linear interpolation between the
/// two nearest ranks: rank q (n - 1) of the sorted samples, counted from 0.
Distribution distributionOf(std::vector<double> samples);

/// How many samples fall into bins of equal width on a logarithmic scale: of runs of any length, and they add up.
struct Histogram {
  static constexpr double kLeast = 1e-3;  ///< lower end of bin 0; what is less is in it, too
  static constexpr int kBinsPerDecade = 20;
  static constexpr int kDecades = 6;

  std::vector<unsigned long long> counts = std::vector<unsigned long long>(kBinsPerDecade * kDecades, 0);

  /// Samples beyond the last bin are in it.
  void add(double sample);
};

Histogram histogramOf(const std::vector<double>& samples);

}  // namespace swarm_planner
