// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/octree_writer.hpp"

#include <octomap/OcTree.h>

#include <sstream>
#include <string>

namespace swarm_planner {

struct OctreeWriter::Tree {
  octomap::OcTree octree;
};

OctreeWriter::OctreeWriter(double resolution) : tree_(new Tree{octomap::OcTree(resolution)}) {}

OctreeWriter::~OctreeWriter() = default;

void OctreeWriter::set(const VoxelIndex& voxel, bool occupied) {
  constexpr int kMiddle = 32768;
  constexpr bool kLazy = true;
  const auto key = [](int i) { return static_cast<octomap::key_type>(i + kMiddle); };
  const octomap::OcTree& tree = tree_->octree;
  const float log_odds = occupied ? tree.getClampingThresMaxLog() : tree.getClampingThresMinLog();
  tree_->octree.setNodeValue(octomap::OcTreeKey(key(voxel.x()), key(voxel.y()), key(voxel.z())), log_odds, kLazy);
}

std::vector<std::uint8_t> OctreeWriter::file() {
  tree_->octree.updateInnerOccupancy();
  tree_->octree.prune();
  std::ostringstream stream;
  tree_->octree.writeBinaryConst(stream);
  const std::string text = stream.str();
  return {text.begin(), text.end()};
}

}  // namespace swarm_planner
