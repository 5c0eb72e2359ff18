// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a map, as file or message, that ends the node with a crash, takes all memory, or has other walls
// than OctoMap itself reads from it.
#include "fuzz_target.hpp"
#include "swarm_planner/map/cloud_map.hpp"
#include "swarm_planner/map/map_file.hpp"
#include "swarm_planner/map/octree_conversion.hpp"
#include "swarm_planner/map/octree_writer.hpp"

namespace swarm_planner {
namespace {

/// A .bt file of a wall, a post, and some free space.
std::string smallFile() {
  OctreeWriter writer(0.1);
  for (int y = -6; y < 6; ++y) {
    for (int z = 0; z < 6; ++z) writer.set({3, y, z}, true);
  }
  for (int z = 0; z < 9; ++z) writer.set({-20, 7, z}, true);
  for (int i = 0; i < 64; ++i) writer.set({i % 4, i / 4 % 4, 8 + i / 16}, false);
  const std::vector<std::uint8_t> bytes = writer.file();
  return std::string(bytes.begin(), bytes.end());
}

void judge(const OctreeData& data) {
  std::string why;
  const auto map = toVoxelMap(data, false, nullptr, why);
  FUZZ_CHECK((map == nullptr) == !why.empty());
  FUZZ_CHECK(why.size() < 400);
  if (map == nullptr) return;
  // What has been looked through is read by OctoMap, too.
  const auto by_octomap = CloudMap(data).voxels(false, map.get(), why);
  FUZZ_CHECK(by_octomap != nullptr && by_octomap->occupiedCount() == map->occupiedCount());
  FUZZ_CHECK(by_octomap->chunks().size() == map->chunks().size());
  for (std::size_t i = 0; i < map->chunks().size(); ++i) {
    FUZZ_CHECK(by_octomap->chunks()[i].chunk == map->chunks()[i].chunk);
  }
  if (const auto known = toVoxelMap(data, true, nullptr, why)) FUZZ_CHECK(known->outsideIsOccupied());
}

}  // namespace

std::vector<std::string> fuzzSeeds() {
  const std::string file = smallFile();
  const std::string nodes = file.substr(file.find("data\n") + 5);
  std::vector<std::string> seeds{file, "\1" + nodes};
  for (const char encoding : {'\1', '\2', '\3'}) {
    for (const std::string& bytes : seedsOfBytes(8, 24, 11)) seeds.push_back(encoding + bytes);
  }
  return seeds;
}

}  // namespace swarm_planner

/// The bytes of a file, or, after a byte that tells how they are encoded, those of a tree.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swarm_planner;
  std::string why;
  if (const auto file = parseMapFile(std::vector<std::uint8_t>(data, data + size), why)) judge(*file);
  if (size == 0 || data[0] < 1 || data[0] > 3) return 0;
  OctreeData tree;
  tree.encoding = static_cast<OctreeEncoding>(data[0] - 1);
  tree.resolution = 0.1;
  tree.bytes.assign(data + 1, data + size);
  judge(tree);
  return 0;
}
