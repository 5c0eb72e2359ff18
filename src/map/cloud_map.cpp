// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/cloud_map.hpp"

#include <octomap/OcTree.h>

#include <sstream>
#include <stdexcept>
#include <utility>

#include "swarm_planner/map/octree_conversion.hpp"
#include "swarm_planner/map/voxel_map_editor.hpp"

namespace swarm_planner {
namespace {

// Half the width of every octree [voxels].
constexpr double kHalfWidth = 32768.0;
// The key of the first voxel beyond the origin along an axis.
constexpr int kMiddle = 32768;

octomap::point3d toPoint(const Vector3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// The nodes of a ColorOcTree without their colours: log odds, three bytes of colour, children.
std::string withoutColors(const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kNode = 8, kLogOdds = 4, kChildren = 7;
  std::string plain;
  for (std::size_t node = 0; node + kNode <= bytes.size(); node += kNode) {
    plain.append(reinterpret_cast<const char*>(bytes.data() + node), kLogOdds);
    plain += static_cast<char>(bytes[node + kChildren]);
  }
  return plain;
}

}  // namespace

struct CloudMap::Tree {
  octomap::OcTree octree;
};

CloudMap::CloudMap(double resolution) : tree_(new Tree{octomap::OcTree(resolution)}) {
  tree_->octree.enableChangeDetection(true);
}

CloudMap::CloudMap(const OctreeData& start, std::shared_ptr<const VoxelMap> present) : CloudMap(start.resolution) {
  std::string why;
  if (!visitOctree(
          start, [](const OctreeCube&) {}, why)) {
    throw std::invalid_argument("no map to add clouds to: " + why);
  }
  std::istringstream stream(start.encoding == OctreeEncoding::kColored
                                ? withoutColors(start.bytes)
                                : std::string(start.bytes.begin(), start.bytes.end()));
  if (start.encoding == OctreeEncoding::kBinary) {
    tree_->octree.readBinaryData(stream);
  } else {
    tree_->octree.readData(stream);
  }
  last_ = std::move(present);
}

CloudMap::~CloudMap() = default;
CloudMap::CloudMap(CloudMap&&) noexcept = default;
CloudMap& CloudMap::operator=(CloudMap&&) noexcept = default;

double CloudMap::resolution() const { return tree_->octree.getResolution(); }

std::size_t CloudMap::insert(const std::vector<Vector3>& points, const Vector3& origin, double max_range) {
  // OctoMap computes in single precision: rays are cut before it sees them. It moves points into the middle of voxels,
  // and cuts rays then: to be cut there, they have to be some voxels longer.
  const double longest = max_range + 3.0 * resolution();
  const double reach = kHalfWidth * resolution() - longest;
  if (!(origin.array().abs() < reach).all()) return 0;
  octomap::Pointcloud cloud;
  cloud.reserve(points.size());
  for (const Vector3& point : points) {
    if (!point.allFinite()) continue;
    const Vector3 ray = point - origin;
    const double length = ray.stableNorm();
    const bool far = length > max_range;
    cloud.push_back(toPoint(far ? Vector3(origin + longest / length * ray) : point));
  }
  constexpr bool kLazy = false, kOncePerVoxel = true;
  tree_->octree.insertPointCloud(cloud, toPoint(origin), max_range, kLazy, kOncePerVoxel);
  return cloud.size();
}

std::shared_ptr<const VoxelMap> CloudMap::voxels(bool unknown_is_occupied, const VoxelMap* previous, std::string& why) {
  std::shared_ptr<const VoxelMap> map;
  if (last_ != nullptr && last_->outsideIsOccupied() == unknown_is_occupied) map = convertChanges();
  if (map == nullptr) map = convertAll(unknown_is_occupied, previous, why);
  if (map == nullptr) return nullptr;
  tree_->octree.resetChangeDetection();
  last_ = map;
  return map;
}

std::shared_ptr<const VoxelMap> CloudMap::convertChanges() const {
  const octomap::OcTree& tree = tree_->octree;
  VoxelMapEditor editor(last_);
  const VoxelIndex low = last_->voxelAt(last_->bounds().min + Vector3::Constant(0.5 * resolution()));
  const VoxelIndex high = last_->voxelAt(last_->bounds().max - Vector3::Constant(0.5 * resolution()));
  auto& octree = tree_->octree;  // OctoMap has no constant access to the keys
  for (auto changed = octree.changedKeysBegin(); changed != octree.changedKeysEnd(); ++changed) {
    const octomap::OcTreeKey& key = changed->first;
    const VoxelIndex voxel = VoxelIndex(key[0], key[1], key[2]).array() - kMiddle;
    const bool is_within = (voxel.array() >= low.array()).all() && (voxel.array() <= high.array()).all();
    if (last_->outsideIsOccupied() && !is_within) return nullptr;
    const octomap::OcTreeNode* node = tree.search(key);
    editor.set(voxel, node != nullptr && tree.isNodeOccupied(node));
  }
  std::shared_ptr<const VoxelMap> map = editor.build();
  return map->chunks().size() <= kMostMapChunks ? map : nullptr;
}

std::shared_ptr<const VoxelMap> CloudMap::convertAll(bool unknown_is_occupied, const VoxelMap* previous,
                                                     std::string& why) const {
  OctreeData data;
  data.resolution = resolution();
  if (tree_->octree.size() > 0) {
    std::ostringstream stream;
    tree_->octree.writeBinaryData(stream);
    const std::string bytes = stream.str();
    data.bytes.assign(bytes.begin(), bytes.end());
  }
  return toVoxelMap(data, unknown_is_occupied, previous, why);
}

}  // namespace swarm_planner
