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

}  // namespace swarm_planner
