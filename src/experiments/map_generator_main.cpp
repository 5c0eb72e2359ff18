// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Makes the maps that ship in config/maps/: map_generator NAME FILE.bt.
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

#include "swarm_planner/experiments/generated_maps.hpp"

int main(int argc, char** argv) {
  using namespace swarm_planner;
  try {
    for (const GeneratedMap& map : generatedMaps()) {
      if (argc != 3 || map.name != argv[1]) continue;
      const std::vector<std::uint8_t> bytes = map.file();
      std::ofstream file(argv[2], std::ios::binary);
      file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      if (file.flush()) return 0;
      std::fprintf(stderr, "map_generator: cannot write %s\n", argv[2]);
      return 1;
    }
    std::fprintf(stderr, "usage: map_generator NAME FILE.bt\nNames:");
    for (const GeneratedMap& map : generatedMaps()) std::fprintf(stderr, " %s", map.name.c_str());
    std::fprintf(stderr, "\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "map_generator: %s\n", error.what());
  }
  return 64;
}
