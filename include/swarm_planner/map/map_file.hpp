// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/map/octree_data.hpp"

namespace swarm_planner {

/// The octree in a file of OctoMap: .bt (binary) or .ot (full), told apart by the first line, of an OcTree or a
/// ColorOcTree. Nothing and `why`, in words, if it is missing, no regular file, longer than kMostMapBytes, or without
/// the header of such a file. Its nodes are not looked at: visitOctree() and toVoxelMap() do that.
std::optional<OctreeData> readMapFile(const std::string& path, std::string& why);

/// The same from the bytes of a file.
std::optional<OctreeData> parseMapFile(std::vector<std::uint8_t> bytes, std::string& why);

}  // namespace swarm_planner
