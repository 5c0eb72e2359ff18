// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a scenario file that ends the node with a crash instead of a list of faults, or one that is
// accepted and means something else when it is written and read again.
#include <cmath>

#include "fuzz_target.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {
namespace {

constexpr char kEveryKey[] = R"(name: all
frame_id: map
end: {all_at_goal: true, timeout: 60.0, tolerance: 0.2}
uavs:
  - {name: uav1, start: [0, 0, 2], reference: [[0, 0, 2], [10, 0, 2], [10, 5, 2]], target: {start: 1.0, speed: 1.5}}
  - name: group/uav2
    start: [0.0, 5.0, 2.0]
    reference: [[0.0, 5.0, 2.0]]
    target: {start: 0.0, speed: 0.0}
obstacles:
  - {id: 1, center: [5, 1, 2], radii: [0.5, 0.5, 3], exponents: [2, 2.5, 8], velocity: [0, 0.1, 0], yaw: 0.3}
  - {id: 2, center: [5, -3, 2], radii: [0.5, 0.5, 3], exponents: [4, 4, 2], velocity: [0, 0, 0]}
workspace: {min: [-5, -8, 0.5], max: [20, 12, 6]}
overrides: {max_speed: 2.0, uav_radius: 0.2, pair_distance: 0.6, max_acceleration: .inf}
)";

}  // namespace

std::vector<std::string> fuzzSeeds() {
  std::vector<std::string> seeds{kEveryKey, "end: {target_x: 1}", "end: {duration: 3}"};
  for (const char* name : {"crossing", "paper_six"}) {
    seeds.push_back(textOf(std::string("config/scenarios/") + name + ".yaml"));
  }
  return seeds;
}

}  // namespace swarm_planner

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swarm_planner;
  Faults faults;
  const Scenario scenario = parseScenarioText(std::string(reinterpret_cast<const char*>(data), size), "fuzz", faults);
  for (const Fault& fault : faults.list()) FUZZ_CHECK(fault.message.size() < 400 && fault.key.size() < 400);
  if (!faults.empty()) return 0;
  const std::string text = toYaml(scenario);
  const Scenario again = parseScenarioText(text, "written", faults);
  FUZZ_CHECK(faults.empty());
  FUZZ_CHECK(toYaml(again) == text);
  try {
    const Mission mission = makeMission(scenario, {}, "fuzz");
    FUZZ_CHECK(mission.parameters.time.sampling_time > 0.0 && mission.parameters.time.cycle_period > 0.0);
    for (const ScenarioObstacle& obstacle : scenario.obstacles) makeObstacle(obstacle);
  } catch (const ConfigError&) {
    // Told, as a user would be.
  }
  return 0;
}
