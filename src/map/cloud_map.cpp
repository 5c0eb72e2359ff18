// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/cloud_map.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
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

bool CloudMap::reaches(const Vector3& origin, double max_range) const {
  return (origin.array().abs() < kHalfWidth * resolution() - longestRay(max_range)).all();
}

double CloudMap::longestRay(double max_range) const { return max_range + 3.0 * resolution(); }

std::size_t CloudMap::insert(const std::vector<Vector3>& points, const Vector3& origin, double max_range,
                             const BodyPlaces& bodies) {
  if (!reaches(origin, max_range)) return 0;
  const double longest = longestRay(max_range);
  const auto isOfBody = [&bodies](const Vector3& point, double around) {
    return std::any_of(bodies.centers.begin(), bodies.centers.end(), [&](const Vector3& center) {
      return ((point - center).cwiseAbs().array() - around).cwiseMax(0.0).matrix().squaredNorm() <
             bodies.radius * bodies.radius;
    });
  };
  octomap::Pointcloud cloud;
  cloud.reserve(points.size());
  for (const Vector3& point : points) {
    if (!point.allFinite() || isOfBody(point, 0.0)) continue;
    const Vector3 ray = point - origin;
    const double length = ray.stableNorm();
    const bool far = length > max_range;
    cloud.push_back(toPoint(far ? Vector3(origin + longest / length * ray) : point));
  }
  octomap::OcTree& octree = tree_->octree;
  octomap::KeySet free, occupied;
  octree.computeDiscreteUpdate(cloud, toPoint(origin), free, occupied, max_range);
  const double half = 0.5 * resolution();
  for (const octomap::OcTreeKey& key : free) {
    const octomap::point3d middle = octree.keyToCoord(key);
    if (!isOfBody({middle.x(), middle.y(), middle.z()}, half)) octree.updateNode(key, false);
  }
  for (const octomap::OcTreeKey& key : occupied) octree.updateNode(key, true);
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
