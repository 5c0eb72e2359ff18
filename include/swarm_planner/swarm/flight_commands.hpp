// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "swarm_planner/swarm/flight_mode.hpp"

namespace swarm_planner {

/// What an operator can ask of a UAV (same numbers as the constants of srv/Command.srv).
enum class FlightCommand : std::uint8_t { kStart = 0, kHold = 1, kLand = 2, kStop = 3, kJoin = 4, kLeave = 5 };
constexpr std::array<FlightCommand, 6> kFlightCommands{FlightCommand::kStart, FlightCommand::kHold,
                                                       FlightCommand::kLand,  FlightCommand::kStop,
                                                       FlightCommand::kJoin,  FlightCommand::kLeave};

/// "start", "hold", ... A string literal.
const char* commandText(FlightCommand command);

/// The answer to a command.
struct CommandAnswer {
  bool accepted = false;
  FlightMode mode = FlightMode::kWaiting;  ///< of the UAV from now on
  std::string text;                        ///< what happens, or why it was refused
};

/// What a swarm does, which a UAV that joins does too.
enum class SwarmActivity : std::uint8_t { kWaiting, kHolding, kFlying };

/// The event that a command is; `activity` matters to kJoin alone.
FlightEvent eventOf(FlightCommand command, SwarmActivity activity);

/// Why a command that was accepted is not carried out at once.
enum class Delay : std::uint8_t { kNone, kRunNotStarted, kOdometryLost };

/// The answer in words to `command`, which made `change` in mode `before`.
CommandAnswer answerTo(FlightCommand command, FlightMode before, const FlightTransition& change, Delay delay);

}  // namespace swarm_planner
