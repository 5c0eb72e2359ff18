// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "scenario_parts.hpp"

#include <cmath>

namespace swarm_planner {

ScenarioUav straightUav(std::size_t number, const Vector3& start, const Vector3& goal, double speed) {
  ScenarioUav uav;
  uav.name = "uav" + std::to_string(number);
  uav.start = start;
  uav.reference = {start, goal};
  uav.target.speed = speed;
  return uav;
}

EndCondition allAtGoal(double timeout) {
  EndCondition end;
  end.all_at_goal = true;
  end.timeout = timeout;
  end.tolerance = 0.2;
  return end;
}

std::string seededName(const std::string& name, std::uint64_t seed) {
  return seed == 0 ? name : name + "_" + std::to_string(seed);
}

Vector3 onCircle(double radius, double angle, double z) {
  return Vector3(roundedToMicro(radius * std::cos(angle)), roundedToMicro(radius * std::sin(angle)), z);
}

Vector3 randomOffset(double most, UniformRandom& random) {
  Vector3 offset;
  for (int axis = 0; axis < 3; ++axis) offset[axis] = random.real(-most, most);
  return offset;
}

Vector3 velocityTowards(double speed, double heading, double climb) {
  return Vector3(roundedToMicro(speed * std::cos(heading) * std::cos(climb)),
                 roundedToMicro(speed * std::sin(heading) * std::cos(climb)), roundedToMicro(speed * std::sin(climb)));
}

}  // namespace swarm_planner
