// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace swarm_planner {

/// Why a message, or a track or transform in it, is not used. The same for every input.
enum class InputFault : std::size_t {
  kNone,
  kNotFinite,
  kAbsurd,       ///< finite, but beyond the limits of config/plausible.hpp
  kOrientation,  ///< a quaternion that is none
  kShape,        ///< radii, exponents or standard deviations that no obstacle has
  kDuplicate,    ///< an id that came before in the same message
  kTooMany,      ///< more tracks, frames or points than are used
  kFromFuture,
  kStale,
  kOutOfOrder,  ///< older than the one before
  kFrame,       ///< unknown, or no name of a frame
  kTooLong,     ///< more bytes than the input takes; not even read
  kMalformed,   ///< the bytes are no message of this type
  kMap,         ///< an octree that is empty, cut off, of another type, of a resolution that no map has
};
constexpr std::size_t kInputFaults = 14;

/// In words, for operators. A string literal.
const char* faultText(InputFault fault);

/// How often each has happened.
class FaultCounts {
 public:
  void add(InputFault fault, std::uint64_t count = 1) { counts_[static_cast<std::size_t>(fault)] += count; }
  void add(const FaultCounts& other);
  std::uint64_t of(InputFault fault) const { return counts_[static_cast<std::size_t>(fault)]; }
  std::uint64_t total() const;

 private:
  std::array<std::uint64_t, kInputFaults> counts_{};
};

/// Longest name of a frame that is looked up [characters].
constexpr std::size_t kLongestName = 255;

/// `text` as it may be shown to operators whoever sent it: at most `most` characters, with the length of the whole
/// behind them if there are more, and a question mark for everything but printable ASCII.
std::string shortened(const std::string& text, std::size_t most = 80);

}  // namespace swarm_planner
