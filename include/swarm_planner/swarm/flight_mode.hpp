// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstdint>

namespace swarm_planner {

/// What a UAV is to do, as commands left it. doc/state_machine.md draws the transitions.
enum class FlightMode : std::uint8_t {
  kWaiting,  ///< not started yet: not planned for
  kFlying,   ///< follows its reference
  kHolding,  ///< brakes and stays; its mission pauses
  kLanding,  ///< brakes, goes to its landing site and descends
  kLanded,   ///< rests on the ground
  kStopped,  ///< stopped as quickly as it could; rests until the next command
  kAbsent,   ///< has left the swarm, or another system flies it: not planned for, others avoid it
};
constexpr std::array<FlightMode, 7> kFlightModes{FlightMode::kWaiting, FlightMode::kFlying, FlightMode::kHolding,
                                                 FlightMode::kLanding, FlightMode::kLanded, FlightMode::kStopped,
                                                 FlightMode::kAbsent};

/// What can happen to a UAV's mode: commands, the start of the run, and the ground.
enum class FlightEvent : std::uint8_t {
  kStart,
  kHold,
  kLand,
  kStop,
  kJoinWaiting,  ///< join a swarm whose run has not started
  kJoinHolding,  ///< join a swarm none of which flies
  kJoinFlying,   ///< join a swarm that flies
  kLeave,
  kRunStarts,  ///< by itself (autostart)
  kTouchdown,  ///< it is where its landing ends
};
constexpr std::array<FlightEvent, 10> kFlightEvents{
    FlightEvent::kStart,       FlightEvent::kHold,        FlightEvent::kLand,       FlightEvent::kStop,
    FlightEvent::kJoinWaiting, FlightEvent::kJoinHolding, FlightEvent::kJoinFlying, FlightEvent::kLeave,
    FlightEvent::kRunStarts,   FlightEvent::kTouchdown};

/// How an event is answered.
enum class FlightAnswer : std::uint8_t {
  kDone,     ///< the mode changes
  kAlready,  ///< it is so already
  kStays,    ///< accepted, and there is nothing to do: what the UAV does is safer still
  kRefused,  ///< not in this mode
  kIgnored,  ///< an event that means nothing in this mode
};

/// The mode after an event, and the answer to it.
struct FlightTransition {
  FlightMode mode = FlightMode::kWaiting;
  FlightAnswer answer = FlightAnswer::kIgnored;

  bool accepted() const { return answer != FlightAnswer::kRefused; }
};
inline bool operator==(const FlightTransition& a, const FlightTransition& b) {
  return a.mode == b.mode && a.answer == b.answer;
}

/// The state machine: one table, an entry for every mode and event.
FlightTransition transition(FlightMode mode, FlightEvent event);

/// Whether motions are planned and setpoints sent for a UAV in this mode once the run has started.
inline bool isPlannedFor(FlightMode mode) { return mode != FlightMode::kWaiting && mode != FlightMode::kAbsent; }

/// In words, for operators: "flying". A string literal.
const char* modeText(FlightMode mode);

}  // namespace swarm_planner
