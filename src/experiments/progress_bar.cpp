// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

/// Arc length from which on the reference stays beyond the plane x = `x`, or the reference's end.
double crossing(const ReferencePath& path, double x) {
  double walked = 0.0;
  const std::vector<Vector3>& points = path.points();
  const bool forward = points.back().x() >= points.front().x();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector3 leg = points[i] - points[i - 1];
    const bool crossed = forward ? points[i].x() >= x : points[i].x() <= x;
    if (crossed) return walked + leg.norm() * (leg.x() != 0.0 ? (x - points[i - 1].x()) / leg.x() : 0.0);
    walked += leg.norm();
  }
  return path.length();
}

}  // namespace

double expectedDuration(const Scenario& scenario) {
  if (scenario.end.duration) return *scenario.end.duration;
  if (!scenario.end.target_x) return scenario.end.timeout;
  double longest = 0.0;
  for (const ScenarioUav& uav : scenario.uavs) {
    if (uav.target.speed == 0.0) continue;
    const double way = crossing(ReferencePath(uav.reference), *scenario.end.target_x) - uav.target.start;
    longest = std::max(longest, way / uav.target.speed);
  }
  return longest;
}

ProgressBar::ProgressBar(std::FILE* stream, std::size_t runs)
    : stream_(stream), terminal_(isatty(fileno(stream)) != 0), runs_(runs) {}

ProgressBar::~ProgressBar() {
  if (terminal_) std::fprintf(stream_, "\r\033[K");
}

void ProgressBar::beginRun(std::size_t index, const Scenario& scenario) {
  run_ = index;
  scenario_ = scenario.name;
  duration_ = expectedDuration(scenario);
}

void ProgressBar::onCycle(double epoch, const CycleReport& report) {
  if (!terminal_) return;
  constexpr int kWidth = 40;
  const double run_share = duration_ > 0.0 ? std::clamp(epoch / duration_, 0.0, 1.0) : 0.0;
  const double share = (static_cast<double>(run_) + run_share) / static_cast<double>(runs_);
  const int permille = static_cast<int>(std::floor(1000.0 * share));
  if (permille == shown_permille_) return;
  shown_permille_ = permille;
  const int filled = permille * kWidth / 1000;
  std::fprintf(stream_, "\r\033[K[%.*s%.*s] %5.1f %%  run %zu of %zu: %s, %.0f s, cycle %.1f ms", filled,
               "########################################", kWidth - filled, "                                        ",
               0.1 * permille, run_ + 1, runs_, scenario_.c_str(), epoch, 1000.0 * report.cycle_time);
  std::fflush(stream_);
}

}  // namespace swarm_planner
