// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/config/fault_injection.hpp"
#include "swarm_planner/config/faults.hpp"
#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// The point that a UAV follows along its reference, stopping at the reference's end.
struct TargetMotion {
  double start = 0.0;  ///< arc length at t = 0 [m]
  double speed = 0.0;  ///< [m/s], >= 0
};

/// One UAV of a scenario.
struct ScenarioUav {
  std::string name;
  Vector3 start = Vector3::Zero();  ///< [m]
  std::vector<Vector3> reference;   ///< polyline [m], at least one point; length zero means: stay
  TargetMotion target;
  bool external = false;  ///< another system flies it: avoided, not planned for
};

/// One superellipsoid obstacle with constant velocity, eq. (7) and (19).
struct ScenarioObstacle {
  int id = 0;
  Vector3 center = Vector3::Zero();            ///< at t = 0 [m]
  Vector3 radii = Vector3::Ones();             ///< a, b, c of (7) [m], > 0
  Vector3 exponents = Vector3::Constant(2.0);  ///< p_x, p_y, p_z of (7), >= 2
  Vector3 velocity = Vector3::Zero();          ///< [m/s]
  double yaw = 0.0;                            ///< about the z axis [rad]
};

/// Axis-aligned box that positions must stay in [m].
struct Workspace {
  Vector3 min = Vector3::Zero();
  Vector3 max = Vector3::Zero();
};

/// When a run ends. Exactly one of the three kinds is set.
struct EndCondition {
  std::optional<double> target_x;  ///< once the last target has crossed this x [m]
  std::optional<double> duration;  ///< after this time [s]
  bool all_at_goal = false;        ///< once every UAV is within tolerance of its reference's end
  double timeout = 0.0;            ///< all_at_goal gives up after this time [s]
  double tolerance = 0.0;          ///< [m]
};

/// A run: UAVs, obstacles, limits. The file format is INTERFACES "Scenario file".
struct Scenario {
  std::string name;
  std::string frame_id = "map";
  EndCondition end;
  std::vector<ScenarioUav> uavs;
  std::vector<ScenarioObstacle> obstacles;
  /// An OctoMap file whose occupied voxels are obstacles; empty: there is none. Whether it can be read is found out
  /// where the mission is put together.
  std::string map_file;
  /// Whatever a map does not know to be free counts as occupied; of the file's map and of those that come in flight.
  bool unknown_is_occupied = false;
  std::optional<Workspace> workspace;
  /// Planner and vehicle parameters that this scenario sets, by their flat names.
  std::map<std::string, double> overrides;
  /// What goes wrong in simulation, in any order.
  std::vector<FaultInjection> faults;
};

/// Parses a scenario from a YAML file. Every fault (unknown, missing or repeated key, wrong type,
/// non-finite number, duplicate name or id, value out of range) is added to `faults`; the scenario
/// returned is usable only if none was added. A relative map_file is one beside the scenario's file.
Scenario parseScenarioFile(const std::string& path, Faults& faults);

/// The same from YAML text; `source` names it in faults. map_file stays as it is written.
Scenario parseScenarioText(const std::string& yaml, const std::string& source, Faults& faults);

/// The scenario as the text of a scenario file. Parsing it gives back exactly the same numbers, and the same
/// scenario always gives the same text.
std::string toYaml(const Scenario& scenario);

}  // namespace swarm_planner
