// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "swarm_planner/map/map_file.hpp"
#include "swarm_planner/map/octree_conversion.hpp"

namespace swarm_planner {

/// Makes voxels known: occupied or free.
template <class Tree>
void mark(Tree& tree, const VoxelIndex& voxel, bool occupied) {
  const auto key = [](int i) { return static_cast<octomap::key_type>(i + 32768); };
  tree.updateNode(octomap::OcTreeKey(key(voxel.x()), key(voxel.y()), key(voxel.z())), occupied);
}

/// Blobs of occupied and free voxels about the origin, some of which prune; the same for the same seed.
template <class Tree = octomap::OcTree>
Tree randomTree(double resolution, unsigned int seed) {
  Tree tree(resolution);
  std::mt19937 random(seed);
  const auto draw = [&random](int most) { return static_cast<int>(random() % static_cast<unsigned int>(most)); };
  for (int blob = 0; blob < 12; ++blob) {
    const VoxelIndex low(draw(90) - 45, draw(90) - 45, draw(40) - 20);
    const VoxelIndex size(1 + draw(12), 1 + draw(12), 1 + draw(6));
    for (int i = 0; i < size.prod(); ++i) {
      mark(tree, low + VoxelIndex(i % size.x(), i / size.x() % size.y(), i / size.x() / size.y()), blob % 3 != 0);
    }
  }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

template <class Tree>
std::vector<std::uint8_t> binaryFile(const Tree& tree) {
  std::ostringstream stream;
  tree.writeBinaryConst(stream);
  const std::string text = stream.str();
  return {text.begin(), text.end()};
}

template <class Tree>
std::vector<std::uint8_t> fullFile(const Tree& tree) {
  std::ostringstream stream;
  tree.write(stream);
  const std::string text = stream.str();
  return {text.begin(), text.end()};
}

/// A file with that header, "id OcTree\nres 0.1\n" for instance, and these bytes after it.
inline std::vector<std::uint8_t> fileOf(const std::string& statements, const std::vector<std::uint8_t>& nodes) {
  const std::string header = "# Octomap OcTree binary file\n" + statements + "data\n";
  std::vector<std::uint8_t> bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), nodes.begin(), nodes.end());
  return bytes;
}

/// The map in the bytes of a file, or null and why.
inline std::shared_ptr<const VoxelMap> mapOf(const std::vector<std::uint8_t>& bytes, std::string& why,
                                             bool unknown_is_occupied = false) {
  const std::optional<OctreeData> data = parseMapFile(bytes, why);
  return data ? toVoxelMap(*data, unknown_is_occupied, nullptr, why) : nullptr;
}

}  // namespace swarm_planner
