// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/map/voxel_map.hpp"

namespace swarm_planner {

/// How OctoMap writes the nodes of a tree, the root first, children in ascending order.
enum class OctreeEncoding {
  kBinary,   ///< two bits per child: unknown, free, occupied, or it has children (.bt, octomap_binary)
  kFull,     ///< per node its log odds as a float, and a bit for each child that there is (.ot, octomap_full)
  kColored,  ///< the same with three bytes of colour after the log odds (ColorOcTree)
};

/// Edges of voxels that maps may have [m]: what sensors resolve, and what UAVs can pass between.
constexpr double kLeastMapResolution = 0.005, kMostMapResolution = 10.0;
/// Of a map, as file or message [bytes]: a hundred million voxels without colour.
constexpr std::size_t kMostMapBytes = 500000000;

/// An octree as OctoMap writes it, not yet read. OctoMap itself trusts such bytes: a chain of nodes without an end
/// overflows its stack. Whatever is read here is read by visitOctree() first.
struct OctreeData {
  OctreeEncoding encoding = OctreeEncoding::kBinary;
  double resolution = 0.0;           ///< edge of a voxel [m]
  std::optional<std::size_t> nodes;  ///< how many there are to be, if that is known
  std::vector<std::uint8_t> bytes;
};

/// The encoding of a tree of type `id`, "OcTree" or "ColorOcTree"; nothing and `why` for others.
std::optional<OctreeEncoding> encodingOf(const std::string& id, bool binary, std::string& why);

/// What is wrong with a resolution [m], in words; empty if nothing is.
std::string resolutionFault(double resolution);

enum class CubeState { kUnknown, kFree, kOccupied };

/// The voxels from `low` on, `width` along each axis, a power of two.
struct OctreeCube {
  VoxelIndex low = VoxelIndex::Zero();
  int width = 1;
  CubeState state = CubeState::kUnknown;
};

/// Calls `visit` for every leaf and for every child that is missing: cubes that do not overlap and fill the tree's 2^16
/// voxels along each axis; those of a larger cube one after the other. False and `why` if the bytes are no such tree:
/// too few or too many of them, nodes deeper than a voxel, log odds that are no number. `visit` may have been called
/// by then.
bool visitOctree(const OctreeData& data, const std::function<void(const OctreeCube&)>& visit, std::string& why);

}  // namespace swarm_planner
