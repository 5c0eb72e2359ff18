// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include "swarm_planner/experiments/closed_loop_run.hpp"

namespace swarm_planner {

/// How long a run of this scenario takes [s], as far as it can be told before: for all_at_goal the timeout.
double expectedDuration(const Scenario& scenario);

/// One line on a terminal that shows how far an experiment is. Silent where the stream is no terminal.
class ProgressBar : public RunObserver {
 public:
  /// `stream` must outlive the bar.
  ProgressBar(std::FILE* stream, std::size_t runs);
  ~ProgressBar() override;

  /// Run `index`, counted from 0, begins.
  void beginRun(std::size_t index, const Scenario& scenario);

  void onSample(double, const std::vector<QuadSimulator>&, const std::vector<Superellipsoid>&) override {}
  void onCycle(double epoch, const CycleReport& report) override;

 private:
  std::FILE* stream_;
  bool terminal_;
  std::size_t runs_;
  std::size_t run_ = 0;
  std::string scenario_;
  double duration_ = 0.0;
  int shown_permille_ = -1;
};

}  // namespace swarm_planner
