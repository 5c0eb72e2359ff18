// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace swarm_planner {

/// A map that this package makes: as the file that ships in config/maps/.
struct GeneratedMap {
  std::string name;  ///< of the file, without its ending
  std::function<std::vector<std::uint8_t>()> file;
};

/// `building`: a floor of 18 m x 12 m, 2.6 m high, at 0.1 m. A corridor 2 m wide along its middle has three rooms on
/// each side; doors are 1 m wide and 2.1 m high, those from room to room 0.9 m. Walls, floor and ceiling are occupied,
/// what is between them is free, and outside nothing is known.
/// `forest`: the trees of forest(10, kForestGap, 0) within its workspace, at 0.2 m: every voxel whose middle is in one.
const std::vector<GeneratedMap>& generatedMaps();

}  // namespace swarm_planner
