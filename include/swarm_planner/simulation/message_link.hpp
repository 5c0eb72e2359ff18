// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "swarm_planner/config/parameters.hpp"
#include "swarm_planner/simulation/random_stream.hpp"

namespace swarm_planner {

/// Decides when messages arrive: `latency` after they were sent, plus a delay uniform in [0, jitter), or never, with
/// probability `drop`.
class LinkDelay {
 public:
  /// Latency, jitter and drop are those of `simulation`.
  LinkDelay(const SimulationParameters& simulation, std::uint64_t seed);

  /// When the next message, sent at `sent`, arrives [s]; nothing: it is lost.
  std::optional<double> arrival(double sent);

 private:
  double latency_, jitter_, drop_;
  RandomStream drops_, delays_;
};

/// A link that carries messages of one kind, such as the odometry of one UAV, and delays, loses and reorders them.
///
/// Messages are sent in the order of their stamps. The receiver keeps the newest by stamp: what arrives after a message
/// that was sent later is discarded.
template <class Message>
class MessageLink {
 public:
  /// `seed` belongs to this link alone.
  MessageLink(const SimulationParameters& simulation, std::uint64_t seed) : delay_(simulation, seed) {}

  /// `message` sets out at `time` [s], not earlier than the one before it. It is lost if the link is full.
  void send(double time, Message message) {
    const std::uint64_t number = ++sent_;
    const std::optional<double> arrival = delay_.arrival(time);
    if (!arrival || under_way_.size() >= kMostUnderWay) return;
    // Behind those that arrive at the same instant: they keep their order.
    const auto later = std::upper_bound(under_way_.begin(), under_way_.end(), *arrival,
                                        [](double t, const Parcel& parcel) { return t < parcel.arrival; });
    under_way_.insert(later, Parcel{*arrival, number, std::move(message)});
  }

  /// Calls receive(arrival, message) for every message that has arrived by `now` [s], in the order of arrival, but for
  /// those that a newer one has overtaken.
  template <class Receive>
  void deliver(double now, Receive&& receive) {
    constexpr double kRounding = 1e-9;  // [s]: a sum of times that should be `now`
    auto parcel = under_way_.begin();
    for (; parcel != under_way_.end() && parcel->arrival <= now + kRounding; ++parcel) {
      if (parcel->number < newest_) continue;
      newest_ = parcel->number;
      receive(parcel->arrival, parcel->message);
    }
    under_way_.erase(under_way_.begin(), parcel);
  }

  /// Loses everything that is under way (time has jumped).
  void clear() { under_way_.clear(); }

 private:
  static constexpr std::size_t kMostUnderWay = 4096;  // 4 s at 1 kHz; a flood does not fill the memory

  struct Parcel {
    double arrival;        ///< [s]
    std::uint64_t number;  ///< from 1, in the order of sending
    Message message;
  };

  LinkDelay delay_;
  std::uint64_t sent_ = 0;
  std::uint64_t newest_ = 0;       ///< number of the newest message delivered
  std::vector<Parcel> under_way_;  ///< by arrival
};

}  // namespace swarm_planner
