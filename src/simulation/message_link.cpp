// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/message_link.hpp"

namespace swarm_planner {

LinkDelay::LinkDelay(const SimulationParameters& simulation, std::uint64_t seed)
    : latency_(simulation.latency),
      jitter_(simulation.jitter),
      drop_(simulation.drop),
      drops_(streamSeed(seed, RandomUse::kDrop)),
      delays_(streamSeed(seed, RandomUse::kJitter)) {}

std::optional<double> LinkDelay::arrival(double sent) {
  // Both are drawn for every message: losses do not change the delays of others, nor the other way round.
  const bool dropped = drops_.nextUniform() < drop_;
  const double delay = latency_ + jitter_ * delays_.nextUniform();
  if (dropped) return std::nullopt;
  return sent + delay;
}

}  // namespace swarm_planner
