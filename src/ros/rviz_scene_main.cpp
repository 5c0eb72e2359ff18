// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Starts rviz with its camera on a scenario: rviz_scene SCENARIO.yaml CONFIG.rviz [arguments of rviz].
// rviz itself cannot choose a view by what there is to see.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "swarm_planner/config/scenario.hpp"
#include "swarm_planner/ros/marker_shapes.hpp"
#include "swarm_planner/ros/rviz_view.hpp"

namespace {

// Writes the fitted configuration to a temporary file; returns its path.
std::string writeFittedConfig(const std::string& scenario_path, const std::string& config_path) {
  using namespace swarm_planner;
  Faults faults;
  const Scenario scenario = parseScenarioFile(scenario_path, faults);
  faults.throwIfAny();
  std::ostringstream config;
  std::ifstream config_file(config_path);
  config << config_file.rdbuf();
  if (!config_file) throw std::runtime_error("cannot read " + config_path);

  std::string path = "/tmp/swarm_planner_XXXXXX.rviz";
  const int file = mkstemps(path.data(), 5);
  if (file < 0) throw std::runtime_error("cannot write to /tmp");
  close(file);
  std::vector<Vector3> points = scenePoints(scenario);
  points.push_back(statusPosition(boundingBox(points)));
  std::ofstream(path) << fitView(config.str(), points, scenario.frame_id);
  return path;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: rviz_scene SCENARIO.yaml CONFIG.rviz [arguments of rviz]\n");
    return 1;
  }
  std::string config = argv[2];
  try {
    config = writeFittedConfig(argv[1], config);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rviz_scene: the camera stays where the configuration has it: %s\n", error.what());
  }
  std::string program = "rviz";
  std::string option = "-d";
  std::vector<char*> arguments = {program.data(), option.data(), config.data()};
  arguments.insert(arguments.end(), argv + 3, argv + argc);
  arguments.push_back(nullptr);
  execvp(program.c_str(), arguments.data());
  std::perror("rviz_scene: cannot start rviz");
  return 1;
}
