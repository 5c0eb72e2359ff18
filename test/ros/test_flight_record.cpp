// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A record that is lost means a swarm that flies off although it was told to stay; one of another flight, or damaged,
// means UAVs that are sent anywhere.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "swarm_planner/ros/flight_record.hpp"

namespace swarm_planner {
namespace {

Mission twoUavs() {
  Mission mission;
  mission.scenario.name = "test";
  for (const double y : {0.0, 10.0}) {
    ScenarioUav uav;
    uav.name = "uav" + std::to_string(mission.scenario.uavs.size() + 1);
    uav.start = Vector3(0, y, 10);
    uav.reference = {uav.start, Vector3(90, y, 10)};
    uav.target.speed = 3.0;
    mission.scenario.uavs.push_back(uav);
  }
  mission.scenario.end.duration = 100.0;
  return mission;
}

class FlightRecordTest : public ::testing::Test {
 protected:
  FlightRecordTest() {
    std::filesystem::remove_all(folder);
    const double now = 100.0;
    Snapshot snapshot;
    for (const ScenarioUav& uav : mission.scenario.uavs)
      snapshot.uavs.push_back({true, now, uav.start, Vector3::Zero()});
    snapshot.now = now;
    planner.plan(snapshot, now + 0.3);
  }
  ~FlightRecordTest() override { std::filesystem::remove_all(folder); }

  /// Dies with a record of two cycles, written at ROS time 100.3 and wall time 1000.
  void leave() {
    FlightRecord record(path, mission, "run", 999.0);
    record.write(planner, 3, 100.0, 999.7);
    Snapshot snapshot;
    for (std::size_t i = 0; i < 2; ++i)
      snapshot.uavs.push_back({true, 100.3, planner.committed(i).start(), Vector3(0, 0, 0)});
    snapshot.now = 100.3;
    before = planner.committed(1);
    planner.plan(snapshot, 100.6);
    record.write(planner, 3, 100.3, 1000.0);
  }

  std::optional<FlightMemory> found(const std::string& run_id, double now, double wall) {
    FlightRecord record(path, mission, run_id, wall);
    std::optional<FlightMemory> memory = record.takeMotions(now, wall);
    why = record.ignored();
    return memory;
  }

  const std::string folder = std::filesystem::temp_directory_path() / ("flight_record_" + std::to_string(::getpid()));
  const std::string path = folder + "/planner";
  const Mission mission = twoUavs();
  SwarmPlanner planner{mission};
  CommittedMotion before;
  std::string why;
};

TEST_F(FlightRecordTest, GivesTheNewestTwoMotionsBackBitByBit) {
  leave();
  const std::optional<FlightMemory> memory = found("run", 101.0, 1001.0);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->time_zero, planner.report().time_zero);
  EXPECT_EQ(memory->obstacles, 3U);
  for (std::size_t i = 0; i < 2; ++i) {
    const UavMemory& uav = memory->uavs[i];
    ASSERT_EQ(uav.motions, 2);
    for (const double t : {100.6, 101.0, 103.7, 150.0}) {
      EXPECT_EQ(uav.newest.at(t).p, planner.committed(i).at(t).p);
      EXPECT_EQ(uav.newest.at(t).a, planner.committed(i).at(t).a);
    }
    EXPECT_EQ(uav.progress, planner.progress(i));
    EXPECT_EQ(uav.target, planner.target(i, 100.6).arc_length);
    EXPECT_EQ(uav.epoch, 100.6);
    EXPECT_TRUE(uav.on_reference);
  }
  EXPECT_EQ(memory->uavs[1].older.at(102.0).p, before.at(102.0).p);
}

TEST_F(FlightRecordTest, CountsOnlyForTheSameFlight) {
  EXPECT_FALSE(found("run", 101.0, 1001.0)) << "there is none";
  EXPECT_EQ(why, "");
  leave();
  EXPECT_FALSE(found("run", 99.0, 1001.0)) << "time has jumped back";
  EXPECT_NE(why, "");
  EXPECT_FALSE(found("run", 101.0, 1001.0)) << "whatever was found has been replaced";
  leave();
  EXPECT_FALSE(found("run", 101.0, 1001.0 + FlightRecord::kLongestWait));
  leave();
  EXPECT_FALSE(found("another master", 101.0, 1001.0 + FlightRecord::kMasterRestart));
  leave();
  EXPECT_TRUE(found("another master", 101.0, 1001.0)) << "the master was restarted, too";
  leave();
  Mission other = mission;
  other.scenario.uavs[0].reference.back().x() += 1.0;
  EXPECT_FALSE(FlightRecord(path, other, "run", 1001.0).takeMotions(101.0, 1001.0));
}

TEST_F(FlightRecordTest, KeepsOrdersUntilThereIsAnotherFlight) {
  {
    FlightRecord record(path, mission, "run", 1000.0);
    EXPECT_TRUE(record.setReference(1, {{Vector3(0.1, 1.0 / 3.0, 1e-9), Vector3(5, 6, 7)}, 0.25, 1.5}));
    EXPECT_TRUE(record.setModes({3, 0}));
    record.write(planner, 0, 100.0, 1000.0);
  }
  for (int restart = 0; restart < 3; ++restart) {
    FlightRecord record(path, mission, "run", 1e6);  // orders have no age
    EXPECT_EQ(record.orders()[0].mode, 3);
    EXPECT_FALSE(record.orders()[0].reference);
    ASSERT_TRUE(record.orders()[1].reference);
    EXPECT_EQ(record.orders()[1].mode, 0);
    EXPECT_EQ(record.orders()[1].reference->path[0], Vector3(0.1, 1.0 / 3.0, 1e-9));
    EXPECT_EQ(record.orders()[1].reference->start, 0.25);
    EXPECT_EQ(record.orders()[1].reference->speed, 1.5);
  }
  EXPECT_EQ(FlightRecord(path, mission, "another", 2e6).orders()[0].mode, 0);
  EXPECT_EQ(FlightRecord(path, mission, "run", 2e6).orders()[0].mode, 0) << "it belongs to the other flight now";
}

TEST_F(FlightRecordTest, TellsThatAReferenceIsNewerThanTheMotions) {
  leave();
  {
    FlightRecord record(path, mission, "run", 1000.0);
    record.write(planner, 0, 100.3, 1000.0);
    record.setReference(0, {{Vector3(0, 0, 10)}, 0.0, 0.0});
  }
  const std::optional<FlightMemory> memory = found("run", 101.0, 1001.0);
  ASSERT_TRUE(memory);
  EXPECT_FALSE(memory->uavs[0].on_reference);
  EXPECT_TRUE(memory->uavs[1].on_reference);
}

TEST_F(FlightRecordTest, LeavesOutWhatIsDamaged) {
  leave();
  const std::string file = path + ".motions";
  const auto size = std::filesystem::file_size(file);
  // A byte in every stretch of the file in turn; whatever comes of it has to be a number.
  for (std::uintmax_t at = 0; at < size; at += 37) {
    leave();
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(at));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(byte ^ 0xff));
    stream.close();
    const std::optional<FlightMemory> memory = found("run", 101.0, 1001.0);
    if (!memory) continue;
    for (const UavMemory& uav : memory->uavs) {
      if (uav.motions > 0) {
        EXPECT_TRUE(uav.newest.isFinite());
      }
    }
  }
  std::ofstream(file, std::ios::trunc) << "short";
  EXPECT_FALSE(found("run", 101.0, 1001.0));
  std::ofstream(path + ".orders.yaml", std::ios::trunc) << "uavs: [1, {name: uav1}]";
  EXPECT_EQ(FlightRecord(path, mission, "run", 1001.0).orders()[0].mode, 0);
}

TEST_F(FlightRecordTest, IsOfOneLivingPlannerAlone) {
  const FlightRecord first(path, mission, "run", 1000.0);
  EXPECT_THROW(FlightRecord(path, mission, "run", 1000.0), std::runtime_error);
}

TEST_F(FlightRecordTest, SaysWhereItCannotBeKept) {
  EXPECT_THROW(FlightRecord("/proc/nowhere/planner", mission, "run", 1000.0), std::runtime_error);
}

TEST(DefaultRecordPath, DiffersBetweenNodesAndMasters) {
  EXPECT_NE(defaultRecordPath("/planner", "http://a:11311"), defaultRecordPath("/other", "http://a:11311"));
  EXPECT_NE(defaultRecordPath("/planner", "http://a:11311"), defaultRecordPath("/planner", "http://b:11311"));
}

}  // namespace
}  // namespace swarm_planner
