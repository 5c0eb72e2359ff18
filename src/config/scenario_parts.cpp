// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "scenario_parts.hpp"

#include <cmath>
#include <string>

#include "portable_numbers.hpp"

namespace swarm_planner {

ScenarioUav straightUav(std::size_t number, const Vector3& start, const Vector3& goal, double speed) {
  ScenarioUav uav;
  uav.name = "uav" + std::to_string(number);
  uav.start = start;
  uav.reference = {start, goal};
  uav.target.speed = speed;
  return uav;
}

EndCondition allAtGoal() {
  EndCondition end;
  end.all_at_goal = true;
  end.timeout = 60.0;
  end.tolerance = 0.2;
  return end;
}

Vector3 velocityTowards(double speed, double heading, double climb) {
  return Vector3(roundedToMicro(speed * std::cos(heading) * std::cos(climb)),
                 roundedToMicro(speed * std::sin(heading) * std::cos(climb)), roundedToMicro(speed * std::sin(climb)));
}

}  // namespace swarm_planner
