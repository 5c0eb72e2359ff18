// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Breaks for the user: a parameter file, or a parameter on the server, that crashes the node or is accepted although no
// planner can work with it.
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "fuzz_target.hpp"
#include "swarm_planner/config/parameter_io.hpp"

namespace swarm_planner {
namespace {

/// A file of this process in memory.
const std::string& scratchFile() {
  static const std::string path = "/dev/shm/swarm_planner_fuzz_" + std::to_string(getpid()) + ".yaml";
  return path;
}

ParameterValue wildValue(FuzzData& data) {
  switch (data.below(4)) {
    case 0:
      return data.below(2) == 1;
    case 1:
      return static_cast<int>(data.below(65536)) - 300;
    case 2:
      return data.wild(0.0, 10.0);
    default:
      return std::string(data.below(2) == 0 ? "auto" : "7.5");
  }
}

void resolve(const ParameterMap& given) {
  Faults faults;
  const Parameters parameters = resolveParameters(given, {}, "fuzz", faults);
  for (const Fault& fault : faults.list()) FUZZ_CHECK(fault.message.size() < 400);
  if (!faults.empty()) return;
  const LimitParameters& limits = parameters.limits;
  const TimeParameters& time = parameters.time;
  FUZZ_CHECK(limits.max_speed > 0.0 && limits.max_speed < 1e4);
  FUZZ_CHECK(limits.pair_distance > 0.0 && limits.pair_distance < 1e9 && limits.tracking_margin >= 0.0);
  FUZZ_CHECK(time.sampling_time > 0.0 && time.sampling_time < 1e3);
  FUZZ_CHECK(time.cycle_period > 0.0 && time.cycle_period < 1e3);
  FUZZ_CHECK(parameters.input.max_tracks >= 1 && parameters.compute.threads >= 1);
}

}  // namespace

std::vector<std::string> fuzzSeeds() {
  std::vector<std::string> seeds;
  for (const char* name : {"planner", "simulation"}) {
    seeds.push_back('F' + textOf(std::string("config/") + name + ".yaml"));
  }
  seeds.push_back(std::string("M\x03\x05\x00\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b\x0c\x0d\x0e", 18));
  seeds.push_back("F{max_speed: 3.0, autostart: false}");
  return seeds;
}

}  // namespace swarm_planner

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace swarm_planner;
  FuzzData data(bytes, size);
  if (data.byte() % 2 == 0) {
    std::ofstream(scratchFile(), std::ios::binary) << data.rest();
    Faults faults;
    const ParameterMap given = parseParameterFile(scratchFile(), false, faults);
    std::remove(scratchFile().c_str());
    resolve(given);
    return 0;
  }
  ParameterMap given;
  const auto& table = parameterTable();
  for (std::size_t count = data.below(12); count > 0; --count)
    given[table[data.below(table.size())].name] = wildValue(data);
  resolve(given);
  return 0;
}
