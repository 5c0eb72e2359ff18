// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "swarm_planner/experiments/closed_loop_run.hpp"

namespace swarm_planner {

/// Writes states.csv, obstacles.csv, cycles.csv and solves.csv of all runs of an experiment, so that anyone can check
/// the reported figures.
class CsvRecorder : public RunObserver {
 public:
  /// Creates `directory` and the four files, replacing those of an earlier experiment. Throws std::runtime_error if
  /// that cannot be done.
  explicit CsvRecorder(const std::string& directory);

  /// What is seen from now on belongs to run `index`, counted from 0.
  void beginRun(std::size_t index, const Scenario& scenario);
  /// Writes out what is buffered. Throws std::runtime_error if anything could not be written.
  void finish();

  void onSample(double t, const std::vector<QuadSimulator>& vehicles,
                const std::vector<Superellipsoid>& obstacles) override;
  void onCycle(double epoch, const CycleReport& report) override;

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Closer>;
  File open(const std::string& name, const char* header) const;

  std::string directory_;
  std::size_t run_ = 0;
  std::vector<std::string> uav_names_;
  File states_, obstacles_, cycles_, solves_;
};

}  // namespace swarm_planner
