// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "scenario_limits.hpp"

#include "number_text.hpp"
#include "swarm_planner/config/plausible.hpp"

namespace swarm_planner {
namespace {

constexpr double kMostYaw = 1e6;  // [rad]
constexpr std::size_t kLongestName = 200;

class Limits {
 public:
  Limits(const std::string& source, Faults& faults) : source_(source), faults_(faults) {}

  void vector(const std::string& key, const Vector3& x, double most) {
    if (!isWithin(x, most)) fault(key, "expected numbers of at most " + formatNumber(most) + " in magnitude");
  }
  void number(const std::string& key, double x, double most) { vector(key, Vector3(x, 0.0, 0.0), most); }
  void fault(const std::string& key, const std::string& message) { faults_.add(source_, key, message); }

 private:
  const std::string& source_;
  Faults& faults_;
};

void judge(const ScenarioUav& uav, const std::string& key, Limits& limits) {
  if (uav.name.size() > kLongestName) limits.fault(key + ".name", "expected at most 200 characters");
  limits.vector(key + ".start", uav.start, kMostCoordinate);
  for (std::size_t i = 0; i < uav.reference.size(); ++i) {
    limits.vector(key + ".reference[" + std::to_string(i) + "]", uav.reference[i], kMostCoordinate);
  }
  if (uav.reference.size() > kMostPathPoints) {
    limits.fault(key + ".reference", "expected at most " + std::to_string(kMostPathPoints) + " points");
  }
  limits.number(key + ".target.speed", uav.target.speed, kMostSpeed);
}

void judge(const ScenarioObstacle& obstacle, const std::string& key, Limits& limits) {
  limits.vector(key + ".center", obstacle.center, kMostCoordinate);
  limits.vector(key + ".velocity", obstacle.velocity, kMostSpeed);
  limits.number(key + ".yaw", obstacle.yaw, kMostYaw);
  if (isPlausibleShape(obstacle.radii, obstacle.exponents)) return;
  limits.fault(key, "expected radii within [" + formatNumber(kLeastRadius) + ", " + formatNumber(kMostRadius) +
                        "] and exponents within [2, " + formatNumber(kMostExponent) + "]");
}

}  // namespace

void addAbsurdNumbers(const Scenario& scenario, const std::string& source, Faults& faults) {
  Limits limits(source, faults);
  for (std::size_t i = 0; i < scenario.uavs.size(); ++i) {
    judge(scenario.uavs[i], "uavs[" + std::to_string(i) + "]", limits);
  }
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    judge(scenario.obstacles[i], "obstacles[" + std::to_string(i) + "]", limits);
  }
  if (!scenario.workspace) return;
  limits.vector("workspace.min", scenario.workspace->min, kMostCoordinate);
  limits.vector("workspace.max", scenario.workspace->max, kMostCoordinate);
}

}  // namespace swarm_planner
