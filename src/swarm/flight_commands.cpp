// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/flight_commands.hpp"

namespace swarm_planner {
namespace {

/// What a UAV begins to do.
const char* undertaking(FlightMode before, FlightMode after) {
  switch (after) {
    case FlightMode::kWaiting:
      return "waits for the start of the run";
    case FlightMode::kFlying:
      if (before == FlightMode::kWaiting) return "starts its mission";
      if (before == FlightMode::kLanded) return "takes off and goes on with its mission";
      if (before == FlightMode::kLanding) return "breaks off its landing and goes on with its mission";
      if (before == FlightMode::kAbsent) return "is planned for again and goes on with its mission";
      return "goes on with its mission";
    case FlightMode::kHolding:
      if (before == FlightMode::kLanding) return "breaks off its landing and holds";
      if (before == FlightMode::kAbsent) return "is planned for again and holds";
      return "brakes and holds";
    case FlightMode::kLanding:
      return "brakes and lands";
    case FlightMode::kLanded:
      return "has landed";
    case FlightMode::kStopped:
      return "stops as quickly as it safely can";
    case FlightMode::kAbsent:
      return "gets no more setpoints; others avoid it";
  }
  return "is in an unknown mode";
}

std::string outcome(FlightCommand command, FlightMode before, const FlightTransition& change) {
  switch (change.answer) {
    case FlightAnswer::kDone:
      return undertaking(before, change.mode);
    case FlightAnswer::kAlready:
      if (command == FlightCommand::kJoin) return std::string("is in the swarm already: ") + modeText(before);
      return std::string("is ") + modeText(before) + " already";
    case FlightAnswer::kStays:
      return std::string("is ") + modeText(before) + " and stays so";
    case FlightAnswer::kRefused:
      return std::string("cannot ") + commandText(command) +
             ": it has left the swarm or is flown by another system; join first";
    case FlightAnswer::kIgnored:
      break;
  }
  return std::string("is ") + modeText(before);
}

}  // namespace

const char* commandText(FlightCommand command) {
  switch (command) {
    case FlightCommand::kStart:
      return "start";
    case FlightCommand::kHold:
      return "hold";
    case FlightCommand::kLand:
      return "land";
    case FlightCommand::kStop:
      return "stop";
    case FlightCommand::kJoin:
      return "join";
    case FlightCommand::kLeave:
      return "leave";
  }
  return "unknown command";
}

FlightEvent eventOf(FlightCommand command, SwarmActivity activity) {
  switch (command) {
    case FlightCommand::kStart:
      return FlightEvent::kStart;
    case FlightCommand::kHold:
      return FlightEvent::kHold;
    case FlightCommand::kLand:
      return FlightEvent::kLand;
    case FlightCommand::kStop:
      return FlightEvent::kStop;
    case FlightCommand::kLeave:
      return FlightEvent::kLeave;
    case FlightCommand::kJoin:
      break;
  }
  if (activity == SwarmActivity::kWaiting) return FlightEvent::kJoinWaiting;
  return activity == SwarmActivity::kFlying ? FlightEvent::kJoinFlying : FlightEvent::kJoinHolding;
}

CommandAnswer answerTo(FlightCommand command, FlightMode before, const FlightTransition& change, Delay delay) {
  CommandAnswer answer;
  answer.accepted = change.accepted();
  answer.mode = change.mode;
  answer.text = outcome(command, before, change);
  if (!answer.accepted || !isPlannedFor(change.mode)) return answer;
  if (delay == Delay::kRunNotStarted) {
    answer.text += "; not before the odometry of every UAV has arrived";
  } else if (delay == Delay::kOdometryLost) {
    answer.text += "; its odometry is lost: once that is back";
  }
  return answer;
}

}  // namespace swarm_planner
