// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The whole program on a small scenario: what a user sees, in files, messages and exit status.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "support/temporary_directory.hpp"
#include "swarm_planner/experiments/experiment_program.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {
namespace {

constexpr const char* kScenario = R"(
name: meeting
frame_id: map
end: {duration: 6.0}
uavs:
  - name: left
    start: [0.0, 0.0, 5.0]
    reference: [[0, 0, 5], [18, 0, 5]]
    target: {start: 0.0, speed: 3.0}
  - name: right
    start: [18.0, 0.0, 5.0]
    reference: [[18, 0, 5], [0, 0, 5]]
    target: {start: 0.0, speed: 3.0}
obstacles:
  - {id: 3, center: [9, 30, 5], radii: [2, 2, 2], exponents: [2, 2, 2], velocity: [0, -1, 0]}
)";

class ExperimentProgramTest : public ::testing::Test {
 protected:
  ExperimentProgramTest() { write("meeting.yaml", kScenario); }

  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(directory_.file(name)) << content;
    return directory_.file(name);
  }
  int run(const std::vector<std::string>& arguments) {
    out_.str("");
    err_.str("");
    return runExperimentProgram(arguments, out_, err_);
  }

  TemporaryDirectory directory_;
  std::ostringstream out_, err_;
};

std::vector<std::vector<std::string>> csvRows(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(contentOf(path));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST_F(ExperimentProgramTest, FliesAScenarioAndReportsIt) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"fly", directory_.file("meeting.yaml"), "--json", json_file, "--seed", "4"}), kExperimentDone)
      << err_.str();
  EXPECT_EQ(err_.str(), "");
  EXPECT_NE(out_.str().find("meeting"), std::string::npos);
  const YAML::Node json = YAML::Load(contentOf(json_file));
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["scenario"].as<std::string>(), "meeting");
  EXPECT_EQ(json[0]["seed"].as<int>(), 4);
  EXPECT_EQ(json[0]["collisions"].as<int>(), 0);
  EXPECT_GE(json[0]["min_uav_distance_m"].as<double>(), 2.0);
  EXPECT_NEAR(json[0]["mission_time_s"].as<double>(), 6.0, 1e-9);
  EXPECT_LT(json[0]["tracking_error_m"]["max"].as<double>(), 0.3);
}

TEST_F(ExperimentProgramTest, WithoutAvoidanceTheCollisionIsSeen) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"fly", directory_.file("meeting.yaml"), "--json", json_file, "--without", "avoidance"}),
            kExperimentDone);
  const YAML::Node json = YAML::Load(contentOf(json_file));
  EXPECT_EQ(json[0]["collisions"].as<int>(), 1);
  EXPECT_LT(json[0]["min_uav_distance_m"].as<double>(), 0.5);
  EXPECT_NE(out_.str().find("left too close to right"), std::string::npos) << out_.str();
}

TEST_F(ExperimentProgramTest, TellsWhatBecameOfInjectedFaults) {
  const std::string file = write(
      "faulty.yaml", std::string(kScenario) + "faults:\n  - {kind: odometry_lost, uav: left, at: 2, duration: 2}\n");
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"fly", file, "--json", json_file}), kExperimentDone) << err_.str();
  const YAML::Node json = YAML::Load(contentOf(json_file))[0];
  ASSERT_EQ(json["faults"].size(), 1u);
  EXPECT_EQ(json["faults"][0]["kind"].as<std::string>(), "odometry_lost");
  EXPECT_EQ(json["faults"][0]["reported"].as<int>(), 1);
  EXPECT_EQ(json["faults"][0]["recovered"].as<int>(), 1);
  EXPECT_LT(json["worst_recovery_s"].as<double>(), 2.0);
  EXPECT_EQ(json["fault_misses"].size(), 0u);
  EXPECT_FALSE(json["rehearsal"]);
  EXPECT_NE(out_.str().find("odometry_lost"), std::string::npos) << out_.str();
}

TEST_F(ExperimentProgramTest, RehearsesForAsLongAsItIsTold) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"rehearse", "--hours", "0.025", "--uavs", "3", "--json", json_file}), kExperimentDone) << err_.str();
  const YAML::Node json = YAML::Load(contentOf(json_file))[0];
  EXPECT_EQ(json["uavs"].as<int>(), 3);
  EXPECT_NEAR(json["mission_time_s"].as<double>(), 90.0, 1e-6);
  EXPECT_GE(json["rehearsal"]["goals_reached"].as<int>(), 6);
  EXPECT_GT(json["rehearsal"]["resident_mb"]["end"].as<double>(), 1.0);
  EXPECT_GE(json["faults"].size(), 5u);
  EXPECT_TRUE(json["flights"][0]["least_time_s"].IsNull()) << "its reference is not what it flies";
}

TEST_F(ExperimentProgramTest, TheCsvFilesBearTheReportOut) {
  const std::string json_file = directory_.file("result.json");
  const std::string csv = directory_.file("new/csv");
  ASSERT_EQ(run({"fly", directory_.file("meeting.yaml"), "--json", json_file, "--csv", csv, "--seeds", "1:2"}),
            kExperimentDone)
      << err_.str();
  const YAML::Node json = YAML::Load(contentOf(json_file));
  ASSERT_EQ(json.size(), 2u);

  const auto states = csvRows(csv + "/states.csv");
  EXPECT_EQ(contentOf(csv + "/states.csv").find("run,time_s,uav,x,y,z,vx,vy,vz,roll,pitch,thrust_n\n"), 0u);
  ASSERT_EQ(states.size(), 1u + 2u * 2u * 601u);
  double least = 1e9;
  for (std::size_t i = 1; i < states.size(); i += 2) {
    ASSERT_EQ(states[i].size(), 12u);
    if (states[i][0] != "1") continue;
    ASSERT_EQ(states[i][2], "left");
    ASSERT_EQ(states[i + 1][2], "right");
    double squared = 0.0;
    for (std::size_t axis = 3; axis < 6; ++axis) {
      squared += std::pow(std::stod(states[i][axis]) - std::stod(states[i + 1][axis]), 2);
    }
    least = std::min(least, std::sqrt(squared));
  }
  EXPECT_NEAR(least, json[1]["min_uav_distance_m"].as<double>(), 1e-5);

  const auto obstacles = csvRows(csv + "/obstacles.csv");
  EXPECT_EQ(obstacles.front(), (std::vector<std::string>{"run", "time_s", "id", "x", "y", "z"}));
  ASSERT_EQ(obstacles.size(), 1u + 2u * 601u);
  EXPECT_NEAR(std::stod(obstacles.back()[4]), 24.0, 1e-5);

  const auto cycles = csvRows(csv + "/cycles.csv");
  EXPECT_EQ(contentOf(csv + "/cycles.csv").find("run,cycle,time_s,cycle_ms,"), 0u);
  EXPECT_EQ(cycles.size(), 1u + 2u * json[0]["cycles"].as<std::size_t>());
  const auto solves = csvRows(csv + "/solves.csv");
  EXPECT_EQ(
      contentOf(csv + "/solves.csv").find("run,cycle,uav,solve_ms,sqp_iterations,qp_iterations,max_slack,state\n"), 0u);
  EXPECT_EQ(solves.size(), 1u + 2u * (cycles.size() - 1u));
  EXPECT_EQ(solves[1].back(), "tracking");
}

TEST_F(ExperimentProgramTest, TheSameSeedGivesTheSameFlight) {
  const auto flight = [this](const std::string& seed) {
    const std::string csv = directory_.file("csv" + seed);
    EXPECT_EQ(run({"fly", directory_.file("meeting.yaml"), "--noise", "0.02", "--seed", seed, "--csv", csv}),
              kExperimentDone);
    return contentOf(csv + "/states.csv");
  };
  const std::string first = flight("1");
  EXPECT_EQ(first, flight("1"));
  EXPECT_NE(first, flight("2"));
}

TEST_F(ExperimentProgramTest, TheFlightDoesNotDependOnTheNumberOfThreads) {
  const auto flight = [this](const std::string& threads) {
    const std::string csv = directory_.file("csv" + threads);
    EXPECT_EQ(run({"circle_swap", "--uavs", "6", "--threads", threads, "--csv", csv}), kExperimentDone) << err_.str();
    return contentOf(csv + "/states.csv");
  };
  EXPECT_EQ(flight("1"), flight("3"));
}

TEST_F(ExperimentProgramTest, DisturbancesOfZeroAreNone) {
  const auto flight = [this](const std::string& name, const std::vector<std::string>& disturbances) {
    const std::string csv = directory_.file(name);
    std::vector<std::string> arguments = {"fly", directory_.file("meeting.yaml"), "--csv", csv};
    arguments.insert(arguments.end(), disturbances.begin(), disturbances.end());
    EXPECT_EQ(run(arguments), kExperimentDone) << err_.str();
    return contentOf(csv + "/states.csv");
  };
  const std::string undisturbed = flight("undisturbed", {});
  EXPECT_EQ(undisturbed, flight("zero", {"--latency", "0", "--jitter", "0", "--drop", "0", "--noise", "0", "--bias",
                                         "0", "--wind", "0", "--seed", "77"}));
  const std::vector<std::vector<std::string>> disturbances = {{"--latency", "0.1"}, {"--jitter", "0.3"},
                                                              {"--drop", "0.5"},    {"--noise", "0.02"},
                                                              {"--bias", "0.05"},   {"--wind", "1"}};
  for (const std::vector<std::string>& disturbance : disturbances) {
    EXPECT_NE(undisturbed, flight(disturbance[0], disturbance)) << disturbance[0];
  }
}

TEST_F(ExperimentProgramTest, ADisturbedFlightFollowsItsSeedForAnyNumberOfThreads) {
  const auto flight = [this](const std::string& seed, const std::string& threads) {
    const std::string csv = directory_.file("csv" + seed + threads);
    EXPECT_EQ(run({"circle_swap", "--uavs", "6",      "--threads", threads,     "--csv",   csv,
                   "--seed",      seed,     "--wind", "1",         "--latency", "0.1",     "--jitter",
                   "0.1",         "--drop", "0.2",    "--bias",    "0.05",      "--noise", "0.02"}),
              kExperimentDone)
        << err_.str();
    return contentOf(csv + "/states.csv");
  };
  const std::string first = flight("0", "1");
  EXPECT_EQ(first, flight("0", "3"));
  EXPECT_NE(first, flight("1", "1"));
}

TEST_F(ExperimentProgramTest, TheReportTellsTheDisturbances) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"fly", directory_.file("meeting.yaml"), "--json", json_file, "--latency", "0.1", "--jitter", "0.05",
                 "--drop", "0.02", "--noise", "0.03", "--bias", "0.04", "--wind", "0.5"}),
            kExperimentDone);
  const YAML::Node told = YAML::Load(contentOf(json_file))[0]["disturbances"];
  EXPECT_EQ(told["latency_s"].as<double>(), 0.1);
  EXPECT_EQ(told["jitter_s"].as<double>(), 0.05);
  EXPECT_EQ(told["drop"].as<double>(), 0.02);
  EXPECT_EQ(told["position_noise_m"].as<double>(), 0.03);
  EXPECT_EQ(told["velocity_noise_mps"].as<double>(), 0.03);
  EXPECT_EQ(told["position_bias_m"].as<double>(), 0.04);
  EXPECT_EQ(told["wind_mps"].as<double>(), 0.5);
}

TEST_F(ExperimentProgramTest, OdometryThatIsTooOldKeepsTheSwarmHoveringAndIsTold) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"fly", directory_.file("meeting.yaml"), "--json", json_file, "--latency", "0.6"}), kExperimentDone);
  const YAML::Node json = YAML::Load(contentOf(json_file))[0];
  EXPECT_LT(json["path_length_m"].as<double>(), 1e-6);
  ASSERT_EQ(json["fallbacks"].size(), 1u);
  EXPECT_EQ(json["fallbacks"][reasonText(Reason::kOdometryStale)].as<int>(), 2 * json["cycles"].as<int>());
  EXPECT_NE(out_.str().find(reasonText(Reason::kOdometryStale)), std::string::npos) << out_.str();
}

TEST_F(ExperimentProgramTest, FaultsOfAllFilesAreListedAndNothingIsFlown) {
  const std::string first = write("first.yaml", "name: first\nframe_id: map\n");
  const std::string second = write("second.yaml", std::string(kScenario) + "speeed: 3\n");
  const std::string json_file = directory_.file("result.json");
  EXPECT_EQ(run({"fly", directory_.file("meeting.yaml"), first, second, "--json", json_file}), kExperimentFailed);
  EXPECT_EQ(out_.str(), "");
  EXPECT_NE(err_.str().find("first.yaml"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("uavs"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("second.yaml"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("speeed"), std::string::npos) << err_.str();
  EXPECT_FALSE(std::filesystem::exists(json_file));
  EXPECT_EQ(run({"fly", directory_.file("missing.yaml")}), kExperimentFailed);
  EXPECT_NE(err_.str().find("missing.yaml"), std::string::npos) << err_.str();
}

TEST_F(ExperimentProgramTest, AParameterFileHoldsForTheRun) {
  const std::string good = write("good.yaml", "avoidance: false\n");
  const std::string bad = write("bad.yaml", "max_sped: 3.0\n");
  ASSERT_EQ(run({"fly", directory_.file("meeting.yaml"), "--params", good}), kExperimentDone) << err_.str();
  EXPECT_NE(out_.str().find("too close"), std::string::npos);
  EXPECT_EQ(run({"fly", directory_.file("meeting.yaml"), "--params", bad}), kExperimentFailed);
  EXPECT_NE(err_.str().find("max_sped"), std::string::npos) << err_.str();
}

TEST_F(ExperimentProgramTest, ResultsThatCannotBeWrittenAreToldBeforeTheFlight) {
  EXPECT_EQ(run({"fly", directory_.file("meeting.yaml"), "--json", directory_.file("missing/result.json")}),
            kExperimentFailed);
  EXPECT_EQ(out_.str(), "");
  EXPECT_NE(err_.str().find("missing/result.json"), std::string::npos);
  EXPECT_EQ(run({"fly", directory_.file("meeting.yaml"), "--csv", directory_.file("meeting.yaml")}), kExperimentFailed);
  EXPECT_EQ(out_.str(), "");
}

TEST_F(ExperimentProgramTest, AWrongCommandLineIsToldFromFailedWork) {
  EXPECT_EQ(run({"fly"}), kExperimentMisused);
  EXPECT_NE(err_.str().find("--help"), std::string::npos);
  EXPECT_EQ(run({"--help"}), kExperimentDone);
  EXPECT_NE(out_.str().find("monte_carlo"), std::string::npos);
}

TEST_F(ExperimentProgramTest, MovingObstaclesFlyAndWhatWasLeftOutIsTold) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"moving_obstacles", "--uavs", "2", "--obstacles", "3", "--seeds", "4:5", "--without", "check",
                 "--without", "latency", "--json", json_file, "--csv", directory_.file("csv")}),
            kExperimentDone)
      << err_.str();
  const YAML::Node json = YAML::Load(contentOf(json_file));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[1]["scenario"].as<std::string>(), "moving_obstacles_5");
  EXPECT_EQ(json[1]["uavs"].as<int>(), 2);
  EXPECT_EQ(json[1]["without"].as<std::vector<std::string>>(), (std::vector<std::string>{"check", "latency"}));
  std::set<std::string> ids;
  const auto rows = csvRows(directory_.file("csv") + "/obstacles.csv");
  for (std::size_t i = 1; i < rows.size(); ++i) ids.insert(rows[i][2]);
  EXPECT_EQ(ids, (std::set<std::string>{"1", "2", "3"}));
}

TEST_F(ExperimentProgramTest, FlightsAreMeasuredAgainstShortestPathsIfAsked) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"dens", "--uavs", "6", "--seed", "1", "--json", json_file, "--shortest-paths"}), kExperimentDone)
      << err_.str();
  const YAML::Node json = YAML::Load(contentOf(json_file))[0];
  EXPECT_EQ(json["scenario"].as<std::string>(), "dens_6_1");
  ASSERT_EQ(json["flights"].size(), 6u);
  for (const YAML::Node& flight : json["flights"]) {
    EXPECT_GT(flight["least_time_s"].as<double>(), 0.0);
    EXPECT_GE((flight["path_length_m"].as<double>() + flight["remaining_m"].as<double>()) /
                  flight["shortest_path_m"].as<double>(),
              0.999);
    if (flight["arrival_time_s"].IsNull()) continue;
    EXPECT_LE(flight["arrival_time_s"].as<double>(), json["mission_time_s"].as<double>());
  }
  ASSERT_EQ(run({"dens", "--uavs", "6", "--seed", "1", "--json", json_file}), kExperimentDone);
  EXPECT_TRUE(YAML::Load(contentOf(json_file))[0]["flights"][0]["shortest_path_m"].IsNull());
}

TEST_F(ExperimentProgramTest, EveryTightPlaceFlies) {
  const std::string json_file = directory_.file("result.json");
  for (const char* command : {"forest", "small_forest", "gap", "box_head_on", "u_trap", "same_goal", "swapj"}) {
    ASSERT_EQ(run({command, "--uavs", "1", "--seed", "1", "--json", json_file}), kExperimentDone) << err_.str();
    const YAML::Node json = YAML::Load(contentOf(json_file))[0];
    EXPECT_EQ(json["uavs"].as<int>(), 1) << command;
    EXPECT_EQ(json["collisions"].as<int>(), 0) << command;
    EXPECT_EQ(json["scenario"].as<std::string>().rfind(command, 0), 0u) << command;
  }
}

TEST_F(ExperimentProgramTest, ALargeCircleHasRoomForAll) {
  ASSERT_EQ(run({"circle_swap", "--uavs", "64", "--without", "avoidance", "--seed", "1"}), kExperimentDone)
      << err_.str();
  EXPECT_EQ(run({"circle_swap", "--uavs", "64", "--radius", "10"}), kExperimentFailed);
  EXPECT_NE(err_.str().find("apart"), std::string::npos) << err_.str();
}

TEST_F(ExperimentProgramTest, GeneratedScenariosFly) {
  const std::string json_file = directory_.file("result.json");
  ASSERT_EQ(run({"circle_swap", "--uavs", "2", "--radius", "10", "--seeds", "0:1", "--json", json_file}),
            kExperimentDone)
      << err_.str();
  const YAML::Node json = YAML::Load(contentOf(json_file));
  ASSERT_EQ(json.size(), 2u);
  for (const YAML::Node& swap : json) {
    EXPECT_EQ(swap["collisions"].as<int>(), 0);
    EXPECT_EQ(swap["arrived_uavs"].as<int>(), 2);
  }
}

}  // namespace
}  // namespace swarm_planner
