// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Closed loop through mapped places: walls, doors, and walls that appear.
#include <gtest/gtest.h>

#include "mapped_places.hpp"
#include "support/random.hpp"
#include "swarm_planner/map/cloud_map.hpp"

namespace swarm_planner {
namespace {

TEST(MapFlights, LeadThroughADoorBesideTheReference) {
  for (const bool mapped : {true, false}) {
    MappedFlight flight(makeIndoorMission({Vector3(-4, -1.5, 1.2)}, {Vector3(4, -1.5, 1.2)}), hallWithDoor(0.9));
    if (mapped) {
      EXPECT_EQ(flight.fly(100), 1U);
      EXPECT_GE(flight.leastVoxelDistance(), 0.2);
    } else {
      PerfectFlight blind(makeIndoorMission({Vector3(-4, -1.5, 1.2)}, {Vector3(4, -1.5, 1.2)}));
      blind.cycles(30);
      EXPECT_GT(blind.vehicle(0).p.x(), 3.0) << "without the map it flies straight through the wall";
    }
  }
}

TEST(MapFlights, SixQueueAtADoor) {
  std::vector<Vector3> starts;
  std::vector<Vector3> ends;
  for (int i = 0; i < 6; ++i) {
    const double side = i < 3 ? -1.0 : 1.0;
    starts.emplace_back(4.0 * side, -2.0 + 2.0 * (i % 3), 1.2);
    ends.emplace_back(-4.0 * side, -2.0 + 2.0 * (i % 3), 1.2);
  }
  MappedFlight flight(makeIndoorMission(starts, ends), hallWithDoor(0.9));
  EXPECT_EQ(flight.fly(250), 6U);
  EXPECT_GE(flight.leastVoxelDistance(), 0.2);
  EXPECT_GT(flight.flight().leastPairGauge(), 1.0);
}

TEST(MapFlights, StayInARoomWithoutADoorThatIsWideEnough) {
  MappedFlight flight(makeIndoorMission({Vector3(-4, -1.5, 1.2)}, {Vector3(4, -1.5, 1.2)}), hallWithDoor(0.3));
  EXPECT_EQ(flight.fly(8), 0U);
  EXPECT_GE(flight.leastVoxelDistance(), 0.2);
  EXPECT_LT(flight.flight().vehicle(0).p.x(), 0.0);
}

TEST(MapFlights, StopBeforeAWallThatAppearsAndGoRoundIt) {
  // Of the door in the wall nothing is known at first, and of the wall neither.
  MappedFlight flight(makeIndoorMission({Vector3(-5, -1.5, 1.2)}, {Vector3(5, -1.5, 1.2)}), PlaceBuilder(0.1).build());
  while (flight.flight().vehicle(0).p.x() < -1.8) flight.cycle();
  EXPECT_GT(flight.flight().vehicle(0).v.x(), 1.0);
  flight.setMap(hallWithDoor(0.9));
  EXPECT_EQ(flight.fly(80), 1U);
  EXPECT_GE(flight.leastVoxelDistance(), 0.2);
}

// The way round the part that is seen first is none: the wall goes on. Nobody is to stand before it for that.
TEST(MapFlights, GoRoundAWallThatTheySeePieceByPiece) {
  constexpr double kRadius = 0.3, kHalfWidth = 2.0, kSpacing = 0.15, kRange = 4.8;
  constexpr std::size_t kRow = 27;
  Random random(7);
  int standing = 0;
  for (int flown = 0; flown < 20; ++flown) {
    Mission mission = makeTestMission({Vector3(random.uniform(-9.0, -8.0), 0.0, 1.5)}, {Vector3(22, 0, 1.5)}, 1.5);
    Faults faults;
    mission.parameters = resolveParameters({}, {{"max_speed", 2.0}, {"uav_radius", kRadius}}, "test", faults);
    faults.throwIfAny();
    MappedFlight flight(mission, PlaceBuilder(0.1).build());
    CloudMap seen(0.1);
    std::shared_ptr<const VoxelMap> map;
    for (int cycle = 0; cycle < 50; ++cycle) {
      const KinematicState x = flight.flight().vehicle(0);
      std::vector<Vector3> points;
      for (std::size_t i = 0; i < kRow * kRow; ++i) {
        const Vector3 point(0.0, kSpacing * static_cast<double>(i % kRow) - kHalfWidth,
                            kSpacing * static_cast<double>(i / kRow));
        if ((point - x.p).norm() < kRange) points.push_back(point);
      }
      std::string why;
      if (seen.insert(points, x.p, kRange) > 0) flight.setMap(map = seen.voxels(false, map.get(), why));
      flight.cycle();
      if (std::abs(x.p.x()) < 5.0 && x.v.norm() < 0.1) ++standing;
    }
    EXPECT_GT(flight.flight().vehicle(0).p.x(), 3.0) << "flight " << flown;
    EXPECT_GE(flight.leastVoxelDistance(), kRadius);
  }
  EXPECT_LE(standing, 20) << "cycles of all flights";
}

// Nobody stops from 1.2 m/s within 0.5 m: it is to come there as slow as it can, not to fly on through the wall.
TEST(MapFlights, BrakeBeforeAWallThatIsTooNear) {
  MappedFlight flight(makeIndoorMission({Vector3(-9, 0, 1.2)}, {Vector3(9, 0, 1.2)}), PlaceBuilder(0.1).build());
  while (flight.flight().vehicle(0).p.x() < -2.0) flight.cycle();
  ASSERT_GT(flight.flight().vehicle(0).v.x(), 1.1);
  const double face = std::ceil(10.0 * (flight.flight().vehicle(0).p.x() + 0.7)) / 10.0;
  PlaceBuilder place(0.1);
  place.addBox({face, -40, -20}, {face + 0.2, 40, 20});
  flight.setMap(place.build());
  for (int i = 0; i < 10; ++i) flight.cycle();
  EXPECT_LT(flight.flight().vehicle(0).p.x(), face + 0.1) << "it did not come out behind the wall";
  EXPECT_LT(flight.flight().vehicle(0).v.norm(), 0.1);
}

TEST(MapFlights, LandAboveAMappedFloor) {
  MappedFlight flight(makeIndoorMission({Vector3(-4, -1.5, 1.2)}, {Vector3(-2, -1.5, 1.2)}), hallWithDoor(0.9));
  flight.fly(30);
  flight.flight().planner().command(0, FlightCommand::kLand);
  for (int i = 0; i < 40; ++i) flight.cycle();
  EXPECT_EQ(flight.flight().planner().mode(0), FlightMode::kLanded);
  EXPECT_LT(flight.flight().vehicle(0).p.z(), 0.5);
  EXPECT_GE(flight.leastVoxelDistance(), 0.2);
}

}  // namespace
}  // namespace swarm_planner
