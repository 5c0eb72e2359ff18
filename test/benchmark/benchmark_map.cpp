// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What it takes to turn an octree into a map that is planned with: of a file that is named, or of a hilly ground of
// SIDE x SIDE occupied voxels. benchmark_map [FILE | SIDE]; times in ms of processor
// time, memory in MB.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/map/cloud_map.hpp"
#include "swarm_planner/map/map_file.hpp"
#include "swarm_planner/map/octree_conversion.hpp"
#include "swarm_planner/map/octree_writer.hpp"

namespace swarm_planner {
namespace {

double milliseconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double medianOf(int runs, const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) times.push_back(milliseconds(work));
  std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
  return times[static_cast<std::size_t>(runs / 2)];
}

OctreeData ground(int side) {
  OctreeWriter writer(0.1);
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      writer.set({x, y, static_cast<int>(40.0 * std::sin(0.011 * x) * std::cos(0.017 * y))}, true);
    }
  }
  std::string why;
  return *parseMapFile(writer.file(), why);
}

int run(const std::string& argument) {
  std::string why;
  const bool is_number = argument.find_first_not_of("0123456789") == std::string::npos;
  const std::optional<OctreeData> data = is_number ? ground(std::stoi(argument)) : readMapFile(argument, why);
  std::shared_ptr<const VoxelMap> map = data ? toVoxelMap(*data, false, nullptr, why) : nullptr;
  if (map == nullptr) {
    std::fprintf(stderr, "%s: %s\n", argument.c_str(), why.c_str());
    return 1;
  }
  std::printf("octree: %zu bytes; map: %zu occupied voxels of %g m, %zu chunks, %.1f MB\n", data->bytes.size(),
              map->occupiedCount(), map->resolution(), map->chunks().size(), static_cast<double>(map->memory()) / 1e6);
  std::printf("check and count: %.1f ms\n", medianOf(5, [&] {
                visitOctree(
                    *data, [](const OctreeCube&) {}, why);
              }));
  std::printf("to a map: %.1f ms\n", medianOf(5, [&] { toVoxelMap(*data, false, nullptr, why); }));
  std::printf("to a map like the one before: %.1f ms\n",
              medianOf(5, [&] { toVoxelMap(*data, false, map.get(), why); }));
  CloudMap cloud(map->resolution());
  std::printf("to add clouds to, once: %.1f ms\n", milliseconds([&] { cloud = CloudMap(*data); }));
  const VoxelIndex middle = map->chunks()[map->chunks().size() / 2].index * VoxelChunk::kSide;
  const Vector3 sensor = map->boxOf(middle).max + Vector3(0, 0, 2.0);
  int clouds = 0;
  const auto insert = [&] {
    std::vector<Vector3> points;
    for (int i = 0; i < 10000; ++i) {
      const double angle = 0.001 * clouds + 0.01 * i;
      points.emplace_back(sensor + 4.0 * Vector3(std::cos(angle), std::sin(angle), -0.0001 * i));
    }
    ++clouds;
    cloud.insert(points, sensor, 5.0);
  };
  std::printf("a cloud of 10,000 points: %.1f ms\n", medianOf(3, insert));
  std::printf("all voxels after the first cloud: %.1f ms\n",
              milliseconds([&] { cloud.voxels(false, map.get(), why); }));
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) {
    insert();
    times.push_back(milliseconds([&] { cloud.voxels(false, nullptr, why); }));
  }
  std::sort(times.begin(), times.end());
  std::printf("those that a further cloud changes: %.1f ms\n", times[times.size() / 2]);
  return 0;
}

}  // namespace
}  // namespace swarm_planner

int main(int argc, char** argv) { return swarm_planner::run(argc > 1 ? argv[1] : "3200"); }
