// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/input_fault.hpp"

#include <algorithm>
#include <numeric>

namespace swarm_planner {

const char* faultText(InputFault fault) {
  switch (fault) {
    case InputFault::kNone:
      return "accepted";
    case InputFault::kNotFinite:
      return "not finite";
    case InputFault::kAbsurd:
      return "absurdly large";
    case InputFault::kOrientation:
      return "bad orientation";
    case InputFault::kShape:
      return "bad shape";
    case InputFault::kDuplicate:
      return "duplicate id";
    case InputFault::kTooMany:
      return "too many";
    case InputFault::kFromFuture:
      return "from the future";
    case InputFault::kStale:
      return "too old";
    case InputFault::kOutOfOrder:
      return "out of order";
    case InputFault::kFrame:
      return "unknown frame";
    case InputFault::kTooLong:
      return "too long";
    case InputFault::kMalformed:
      return "malformed";
    case InputFault::kMap:
      return "no usable map";
  }
  return "";
}

void FaultCounts::add(const FaultCounts& other) {
  for (std::size_t i = 0; i < kInputFaults; ++i) counts_[i] += other.counts_[i];
}

std::uint64_t FaultCounts::total() const { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }

std::string shortened(const std::string& text, std::size_t most) {
  std::string shown = text.substr(0, most);
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  if (text.size() > most) shown += "... (" + std::to_string(text.size()) + " characters)";
  return shown;
}

}  // namespace swarm_planner
