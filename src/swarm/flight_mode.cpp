// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/flight_mode.hpp"

namespace swarm_planner {
namespace {

constexpr FlightTransition done(FlightMode mode) { return {mode, FlightAnswer::kDone}; }
constexpr FlightTransition already(FlightMode mode) { return {mode, FlightAnswer::kAlready}; }
constexpr FlightTransition stays(FlightMode mode) { return {mode, FlightAnswer::kStays}; }
constexpr FlightTransition refused(FlightMode mode) { return {mode, FlightAnswer::kRefused}; }
constexpr FlightTransition ignored(FlightMode mode) { return {mode, FlightAnswer::kIgnored}; }

constexpr FlightMode W = FlightMode::kWaiting;
constexpr FlightMode F = FlightMode::kFlying;
constexpr FlightMode H = FlightMode::kHolding;
constexpr FlightMode D = FlightMode::kLanding;
constexpr FlightMode G = FlightMode::kLanded;
constexpr FlightMode S = FlightMode::kStopped;
constexpr FlightMode A = FlightMode::kAbsent;

using Row = std::array<FlightTransition, kFlightEvents.size()>;

/// Rows are modes, columns events, both in the order of their declaration.
constexpr std::array<Row, kFlightModes.size()> kTable{{
    // clang-format off
    // start, hold, land, stop; join (waiting, holding, flying), leave, run starts, touchdown
    {{done(F),    done(H),    done(D),    done(S),
      already(W), already(W), already(W), done(A), done(F), ignored(W)}},
    {{already(F), done(H),    done(D),    done(S),
      already(F), already(F), already(F), done(A), ignored(F), ignored(F)}},
    {{done(F),    already(H), done(D),    done(S),
      already(H), already(H), already(H), done(A), ignored(H), ignored(H)}},
    {{done(F),    done(H),    already(D), done(S),
      already(D), already(D), already(D), done(A), ignored(D), done(G)}},
    {{done(F),    stays(G),   already(G), stays(G),
      already(G), already(G), already(G), done(A), ignored(G), ignored(G)}},
    {{done(F),    stays(S),   done(D),    already(S),
      already(S), already(S), already(S), done(A), ignored(S), ignored(S)}},
    {{refused(A), refused(A), refused(A), refused(A),
      done(W), done(H), done(F), already(A), ignored(A), ignored(A)}},
    // clang-format on
}};

}  // namespace

FlightTransition transition(FlightMode mode, FlightEvent event) {
  return kTable[static_cast<std::size_t>(mode)][static_cast<std::size_t>(event)];
}

const char* modeText(FlightMode mode) {
  switch (mode) {
    case FlightMode::kWaiting:
      return "waiting";
    case FlightMode::kFlying:
      return "flying";
    case FlightMode::kHolding:
      return "holding";
    case FlightMode::kLanding:
      return "landing";
    case FlightMode::kLanded:
      return "landed";
    case FlightMode::kStopped:
      return "stopped";
    case FlightMode::kAbsent:
      return "absent";
  }
  return "unknown mode";
}

}  // namespace swarm_planner
