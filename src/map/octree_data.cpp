// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/octree_data.hpp"

#include <cmath>
#include <cstring>
#include <sstream>

namespace swarm_planner {
namespace {

constexpr int kTreeWidth = 1 << 16;  // voxels along an edge of every OctoMap
constexpr std::size_t kColorBytes = 3;

/// The voxels that child `child` of a cube has: bits 0, 1, 2 of the number stand for the upper half in x, y, z.
OctreeCube childOf(const OctreeCube& cube, unsigned int child) {
  OctreeCube half{cube.low, cube.width / 2, CubeState::kUnknown};
  for (unsigned int axis = 0; axis < 3; ++axis) {
    if (((child >> axis) & 1U) != 0) half.low[static_cast<int>(axis)] += half.width;
  }
  return half;
}

class TreeReader {
 public:
  TreeReader(const OctreeData& data, const std::function<void(const OctreeCube&)>& visit)
      : data_(data), visit_(visit) {}

  bool read() {
    const OctreeCube root{VoxelIndex::Constant(-kTreeWidth / 2), kTreeWidth, CubeState::kUnknown};
    return data_.encoding == OctreeEncoding::kBinary ? readBinary(root) : readFull(root);
  }
  std::size_t nodes() const { return nodes_; }
  std::size_t bytesLeft() const { return data_.bytes.size() - at_; }
  const std::string& why() const { return why_; }

 private:
  bool fail(const char* why) {
    why_ = why;
    return false;
  }

  bool take(void* to, std::size_t size) {
    if (size > bytesLeft()) return fail("it is cut off");
    std::memcpy(to, data_.bytes.data() + at_, size);
    at_ += size;
    return true;
  }

  /// A node that has children.
  bool readBinary(const OctreeCube& cube) {
    constexpr unsigned int kFreeBits = 1, kOccupiedBits = 2, kChildrenBits = 3;
    std::uint16_t bits = 0;  // little endian, as OctoMap's bytes are
    if (cube.width == 1) return fail("nodes lie deeper than its voxels");
    if (!take(&bits, sizeof(bits))) return false;
    ++nodes_;
    // A child's own children follow after the bits of all children.
    for (unsigned int i = 0; i < 8; ++i) {
      OctreeCube child = childOf(cube, i);
      const unsigned int kind = (static_cast<unsigned int>(bits) >> (2 * i)) & 3U;
      if (kind == kChildrenBits) {
        if (!readBinary(child)) return false;
        continue;
      }
      if (kind == kFreeBits) child.state = CubeState::kFree;
      if (kind == kOccupiedBits) child.state = CubeState::kOccupied;
      if (kind != 0) ++nodes_;
      visit_(child);
    }
    return true;
  }

  bool readFull(OctreeCube cube) {
    float log_odds = 0.0F;
    std::uint8_t color[kColorBytes];
    std::uint8_t children = 0;
    if (!take(&log_odds, sizeof(log_odds))) return false;
    if (data_.encoding == OctreeEncoding::kColored && !take(color, sizeof(color))) return false;
    if (!take(&children, sizeof(children))) return false;
    if (std::isnan(log_odds)) return fail("a node's log odds are no number");
    ++nodes_;
    if (children == 0) {
      cube.state = log_odds >= 0.0F ? CubeState::kOccupied : CubeState::kFree;
      visit_(cube);
      return true;
    }
    if (cube.width == 1) return fail("nodes lie deeper than its voxels");
    for (unsigned int i = 0; i < 8; ++i) {
      const OctreeCube child = childOf(cube, i);
      if (((static_cast<unsigned int>(children) >> i) & 1U) == 0) {
        visit_(child);
      } else if (!readFull(child)) {
        return false;
      }
    }
    return true;
  }

  const OctreeData& data_;
  const std::function<void(const OctreeCube&)>& visit_;
  std::size_t at_ = 0;
  std::size_t nodes_ = 0;
  std::string why_;
};

}  // namespace

std::optional<OctreeEncoding> encodingOf(const std::string& id, bool binary, std::string& why) {
  const bool colored = id == "ColorOcTree";
  if (!colored && id != "OcTree") {
    why = "a tree of type '" + id.substr(0, 80) + "', expected OcTree or ColorOcTree";
    return std::nullopt;
  }
  if (binary) return OctreeEncoding::kBinary;
  return colored ? OctreeEncoding::kColored : OctreeEncoding::kFull;
}

std::string resolutionFault(double resolution) {
  if (resolution >= kLeastMapResolution && resolution <= kMostMapResolution) return "";
  std::ostringstream text;
  text << "a resolution of " << resolution << " m, expected one within [" << kLeastMapResolution << ", "
       << kMostMapResolution << "]";
  return text.str();
}

bool visitOctree(const OctreeData& data, const std::function<void(const OctreeCube&)>& visit, std::string& why) {
  why = resolutionFault(data.resolution);
  if (!why.empty()) return false;
  if (data.bytes.empty()) {
    why = "it is empty";
    return false;
  }
  TreeReader reader(data, visit);
  if (!reader.read()) {
    why = reader.why();
  } else if (reader.bytesLeft() > 0) {
    why = std::to_string(reader.bytesLeft()) + " bytes follow its last node";
  } else if (data.nodes && *data.nodes != reader.nodes()) {
    why = "it has " + std::to_string(reader.nodes()) + " nodes in place of " + std::to_string(*data.nodes);
  }
  return why.empty();
}

}  // namespace swarm_planner
