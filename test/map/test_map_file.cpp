// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, walls of a map are not where the file says, or a bad file ends the program, fills the memory, or is
// taken for a map without obstacles.
#include <gtest/gtest.h>

#include <fstream>

#include "octree_files.hpp"
#include "support/temporary_directory.hpp"

namespace swarm_planner {
namespace {

constexpr double kResolution = 0.1;

/// Every voxel about the origin is occupied in the map exactly if OctoMap itself says so.
template <class Tree>
void expectSame(const VoxelMap& map, const Tree& tree, bool unknown_is_occupied) {
  std::size_t occupied = 0;
  for (int x = -70; x < 70; ++x) {
    for (int y = -70; y < 70; ++y) {
      for (int z = -40; z < 40; ++z) {
        const Vector3 p = map.resolution() * (Vector3(x, y, z) + Vector3::Constant(0.5));
        const auto* node = tree.search(p.x(), p.y(), p.z());
        const bool expected = node == nullptr ? unknown_is_occupied : tree.isNodeOccupied(node);
        ASSERT_EQ(map.isOccupied(p), expected) << p.transpose();
        occupied += expected ? 1 : 0;
      }
    }
  }
  EXPECT_GT(occupied, 300U);
}

TEST(MapFile, EveryVoxelOfABinaryFileIsAsOctoMapReadsIt) {
  for (unsigned int seed = 0; seed < 3; ++seed) {
    auto tree = randomTree(kResolution, seed);
    tree.toMaxLikelihood();
    tree.prune();
    std::string why;
    const auto map = mapOf(binaryFile(tree), why);
    ASSERT_NE(map, nullptr) << why;
    expectSame(*map, tree, false);
  }
}

TEST(MapFile, EveryVoxelOfAFullFileIsAsOctoMapReadsIt) {
  const auto tree = randomTree(kResolution, 7);
  std::string why;
  const auto map = mapOf(fullFile(tree), why);
  ASSERT_NE(map, nullptr) << why;
  EXPECT_DOUBLE_EQ(map->resolution(), kResolution);
  expectSame(*map, tree, false);
}

TEST(MapFile, ColorsDoNotMatter) {
  const auto tree = randomTree<octomap::ColorOcTree>(kResolution, 8);
  std::string why;
  const auto map = mapOf(fullFile(tree), why);
  ASSERT_NE(map, nullptr) << why;
  expectSame(*map, tree, false);
}

TEST(MapFile, UnknownSpaceIsOccupiedWhereAskedFor) {
  const auto tree = randomTree(kResolution, 9);
  std::string why;
  const auto map = mapOf(fullFile(tree), why, true);
  ASSERT_NE(map, nullptr) << why;
  EXPECT_TRUE(map->outsideIsOccupied());
  expectSame(*map, tree, true);
}

TEST(MapFile, AFileIsReadFromDisk) {
  const TemporaryDirectory directory;
  const std::vector<std::uint8_t> bytes = binaryFile(randomTree(kResolution, 1));
  std::ofstream(directory.file("map.bt"), std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::string why;
  const auto data = readMapFile(directory.file("map.bt"), why);
  ASSERT_TRUE(data) << why;
  EXPECT_NE(toVoxelMap(*data, false, nullptr, why), nullptr) << why;
}

TEST(MapFile, WhatIsNoFileIsRefused) {
  const TemporaryDirectory directory;
  std::string why;
  EXPECT_FALSE(readMapFile(directory.file("missing.bt"), why));
  EXPECT_EQ(why, "there is no such file");
  for (const std::string& path : {directory.file("."), std::string("/dev/zero")}) {
    EXPECT_FALSE(readMapFile(path, why));
    EXPECT_EQ(why, "it is no regular file") << path;
  }
  std::ofstream(directory.file("empty.bt")).close();
  EXPECT_FALSE(readMapFile(directory.file("empty.bt"), why));
  EXPECT_EQ(why, "it is empty");
}

struct BadFile {
  const char* statements;
  std::vector<std::uint8_t> nodes;
  const char* why;
};

TEST(MapFile, BadFilesAreRefusedInWords) {
  const std::vector<std::uint8_t> two_free = {0x05, 0x00};
  const BadFile bad[] = {
      {"id OcTreeStamped\nres 0.1\n", two_free, "a tree of type 'OcTreeStamped'"},
      {"res 0.1\n", two_free, "a tree of type ''"},
      {"id OcTree\n", two_free, "a resolution of nan m"},
      {"id OcTree\nres 0\n", two_free, "a resolution of 0 m"},
      {"id OcTree\nres nan\n", two_free, "a resolution of nan m"},
      {"id OcTree\nres -0.1\n", two_free, "a resolution of -0.1 m"},
      {"id OcTree\nres 1e300\n", two_free, "a resolution of 1e+300 m"},
      {"id OcTree\nres 0.1\nsize 1000000000000\n", two_free, "it has 3 nodes in place of 1000000000000"},
      {"id OcTree\nres 0.1\nsize many\n", two_free, "its header has the line 'size many'"},
      {"id OcTree\nres 0.1\nsice 3\n", two_free, "its header has the line 'sice 3'"},
      {"id OcTree\nres 0.1\n", {}, "it is empty"},
      {"id OcTree\nres 0.1\n", {0x00, 0x00}, "it is empty: nothing in it is known"},
      {"id OcTree\nres 0.1\n", {0x03}, "it is cut off"},
      {"id OcTree\nres 0.1\n", {0x03, 0x00, 0x01}, "it is cut off"},
      {"id OcTree\nres 0.1\n", {0x05, 0x00, 0x00}, "1 bytes follow its last node"},
      {"id OcTree\nres 0.1\n", std::vector<std::uint8_t>(1000000, 0x03), "nodes lie deeper than its voxels"},
      {"id OcTree\nres 0.1\n", {0x02, 0x00}, "it is too large"},
  };
  for (const BadFile& file : bad) {
    std::string why;
    EXPECT_EQ(mapOf(fileOf(file.statements, file.nodes), why), nullptr) << file.why;
    EXPECT_NE(why.find(file.why), std::string::npos) << why << "\nexpected: " << file.why;
  }
}

TEST(MapFile, FilesOfAnotherKindAreRefused) {
  for (const std::string text : {"", "\n", "# Octomap OcTree binary file", "# Octomap OcTree binary file\nid OcTree\n",
                                 "name: paper_six\n", "# Octomap OcTree binary file v2\ndata\n"}) {
    std::string why;
    EXPECT_EQ(mapOf({text.begin(), text.end()}, why), nullptr) << text;
    EXPECT_FALSE(why.empty()) << text;
  }
}

TEST(MapFile, EveryTruncationIsRefused) {
  for (const std::vector<std::uint8_t>& whole :
       {binaryFile(randomTree(kResolution, 3)), fullFile(randomTree(kResolution, 3))}) {
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 300) {
      std::string why;
      EXPECT_EQ(mapOf({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}, why), nullptr) << size;
      EXPECT_FALSE(why.empty()) << size;
    }
  }
}

TEST(MapFile, NoByteThatIsWrongEndsTheProgram) {
  std::mt19937 random(5);
  std::size_t refused = 0;
  const std::vector<std::uint8_t> files[] = {binaryFile(randomTree(kResolution, 4)),
                                             fullFile(randomTree(kResolution, 4))};
  for (std::size_t i = 0; i < 1000; ++i) {
    std::vector<std::uint8_t> bytes = files[i % 2];
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    std::string why;
    refused += mapOf(bytes, why) == nullptr ? 1 : 0;
  }
  EXPECT_GT(refused, 250U);
}

}  // namespace
}  // namespace swarm_planner
