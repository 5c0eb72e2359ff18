// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The state machine of a UAV. If these fail, a command does what nobody expects of it, or nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "swarm_planner/swarm/flight_commands.hpp"
#include "swarm_planner/swarm/flight_mode.hpp"

namespace swarm_planner {
namespace {

/// The transitions of doc/state_machine.md: what is not listed for a mode is ignored.
struct Expected {
  const char* mode;
  const char* event;
  const char* answer;
  const char* next;
};
const std::vector<Expected> kExpected{
    {"waiting", "start", "done", "flying"},
    {"waiting", "hold", "done", "holding"},
    {"waiting", "land", "done", "landing"},
    {"waiting", "stop", "done", "stopped"},
    {"waiting", "join waiting", "already", "waiting"},
    {"waiting", "join holding", "already", "waiting"},
    {"waiting", "join flying", "already", "waiting"},
    {"waiting", "leave", "done", "absent"},
    {"waiting", "run starts", "done", "flying"},
    {"waiting", "touchdown", "ignored", "waiting"},

    {"flying", "start", "already", "flying"},
    {"flying", "hold", "done", "holding"},
    {"flying", "land", "done", "landing"},
    {"flying", "stop", "done", "stopped"},
    {"flying", "join waiting", "already", "flying"},
    {"flying", "join holding", "already", "flying"},
    {"flying", "join flying", "already", "flying"},
    {"flying", "leave", "done", "absent"},
    {"flying", "run starts", "ignored", "flying"},
    {"flying", "touchdown", "ignored", "flying"},

    {"holding", "start", "done", "flying"},
    {"holding", "hold", "already", "holding"},
    {"holding", "land", "done", "landing"},
    {"holding", "stop", "done", "stopped"},
    {"holding", "join waiting", "already", "holding"},
    {"holding", "join holding", "already", "holding"},
    {"holding", "join flying", "already", "holding"},
    {"holding", "leave", "done", "absent"},
    {"holding", "run starts", "ignored", "holding"},
    {"holding", "touchdown", "ignored", "holding"},

    {"landing", "start", "done", "flying"},
    {"landing", "hold", "done", "holding"},
    {"landing", "land", "already", "landing"},
    {"landing", "stop", "done", "stopped"},
    {"landing", "join waiting", "already", "landing"},
    {"landing", "join holding", "already", "landing"},
    {"landing", "join flying", "already", "landing"},
    {"landing", "leave", "done", "absent"},
    {"landing", "run starts", "ignored", "landing"},
    {"landing", "touchdown", "done", "landed"},

    {"landed", "start", "done", "flying"},
    {"landed", "hold", "stays", "landed"},
    {"landed", "land", "already", "landed"},
    {"landed", "stop", "stays", "landed"},
    {"landed", "join waiting", "already", "landed"},
    {"landed", "join holding", "already", "landed"},
    {"landed", "join flying", "already", "landed"},
    {"landed", "leave", "done", "absent"},
    {"landed", "run starts", "ignored", "landed"},
    {"landed", "touchdown", "ignored", "landed"},

    {"stopped", "start", "done", "flying"},
    {"stopped", "hold", "stays", "stopped"},
    {"stopped", "land", "done", "landing"},
    {"stopped", "stop", "already", "stopped"},
    {"stopped", "join waiting", "already", "stopped"},
    {"stopped", "join holding", "already", "stopped"},
    {"stopped", "join flying", "already", "stopped"},
    {"stopped", "leave", "done", "absent"},
    {"stopped", "run starts", "ignored", "stopped"},
    {"stopped", "touchdown", "ignored", "stopped"},

    {"absent", "start", "refused", "absent"},
    {"absent", "hold", "refused", "absent"},
    {"absent", "land", "refused", "absent"},
    {"absent", "stop", "refused", "absent"},
    {"absent", "join waiting", "done", "waiting"},
    {"absent", "join holding", "done", "holding"},
    {"absent", "join flying", "done", "flying"},
    {"absent", "leave", "already", "absent"},
    {"absent", "run starts", "ignored", "absent"},
    {"absent", "touchdown", "ignored", "absent"},
};

const std::vector<std::string> kEventNames{"start",        "hold",        "land",  "stop",       "join waiting",
                                           "join holding", "join flying", "leave", "run starts", "touchdown"};
const std::vector<std::string> kAnswerNames{"done", "already", "stays", "refused", "ignored"};

std::string nameOf(FlightEvent event) { return kEventNames.at(static_cast<std::size_t>(event)); }
std::string nameOf(FlightAnswer answer) { return kAnswerNames.at(static_cast<std::size_t>(answer)); }

TEST(FlightMode, EveryPairOfModeAndEventDoesWhatIsDocumented) {
  std::size_t pairs = 0;
  for (const FlightMode mode : kFlightModes) {
    for (const FlightEvent event : kFlightEvents) {
      const auto matches = [&](const Expected& row) {
        return row.mode == std::string(modeText(mode)) && row.event == nameOf(event);
      };
      ASSERT_EQ(std::count_if(kExpected.begin(), kExpected.end(), matches), 1)
          << modeText(mode) << ", " << nameOf(event);
      const Expected& row = *std::find_if(kExpected.begin(), kExpected.end(), matches);
      const FlightTransition change = transition(mode, event);
      EXPECT_STREQ(modeText(change.mode), row.next) << row.mode << ", " << row.event;
      EXPECT_EQ(nameOf(change.answer), row.answer) << row.mode << ", " << row.event;
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, kExpected.size());
}

TEST(FlightMode, OnlyWhatIsDoneChangesTheMode) {
  for (const FlightMode mode : kFlightModes) {
    for (const FlightEvent event : kFlightEvents) {
      const FlightTransition change = transition(mode, event);
      EXPECT_EQ(change.mode != mode, change.answer == FlightAnswer::kDone) << modeText(mode) << ", " << nameOf(event);
    }
  }
}

// Given twice in a row, a command changes nothing more.
TEST(FlightMode, ACommandTwiceIsACommandOnce) {
  for (const FlightMode mode : kFlightModes) {
    for (const FlightCommand command : kFlightCommands) {
      for (const SwarmActivity activity : {SwarmActivity::kWaiting, SwarmActivity::kHolding, SwarmActivity::kFlying}) {
        const FlightEvent event = eventOf(command, activity);
        const FlightMode once = transition(mode, event).mode;
        EXPECT_EQ(transition(once, event).mode, once) << modeText(mode) << ", " << nameOf(event);
      }
    }
  }
}

// From any mode to any that a command can ask for: no dead end.
TEST(FlightMode, EveryModeCanBeLeft) {
  for (const FlightMode from : kFlightModes) {
    std::set<FlightMode> reached{from};
    for (std::size_t round = 0; round < kFlightModes.size(); ++round) {
      for (const FlightMode mode : std::set<FlightMode>(reached)) {
        for (const FlightEvent event : kFlightEvents) reached.insert(transition(mode, event).mode);
      }
    }
    EXPECT_EQ(reached.size(), kFlightModes.size()) << modeText(from);
  }
}

// The table in the manual is the one that flies.
TEST(FlightMode, TheManualHasTheSameTable) {
  std::ifstream file("doc/state_machine.md");
  ASSERT_TRUE(file) << "tests run in the package's folder";
  std::stringstream text;
  text << file.rdbuf();
  for (const FlightMode mode : kFlightModes) {
    std::string row = std::string("| ") + modeText(mode) + " |";
    for (const FlightEvent event : {FlightEvent::kStart, FlightEvent::kHold, FlightEvent::kLand, FlightEvent::kStop,
                                    FlightEvent::kJoinWaiting, FlightEvent::kJoinHolding, FlightEvent::kJoinFlying,
                                    FlightEvent::kLeave, FlightEvent::kRunStarts, FlightEvent::kTouchdown}) {
      const FlightTransition change = transition(mode, event);
      row += " " +
             (change.answer == FlightAnswer::kDone ? std::string("**") + modeText(change.mode) + "**"
                                                   : nameOf(change.answer)) +
             " |";
    }
    EXPECT_NE(text.str().find(row + "\n"), std::string::npos) << "expected the line\n" << row;
  }
}

TEST(CommandAnswer, SaysWhatHappensOrWhyNot) {
  const auto answer = [](FlightCommand command, FlightMode mode, Delay delay) {
    return answerTo(command, mode, transition(mode, eventOf(command, SwarmActivity::kFlying)), delay);
  };
  EXPECT_EQ(answer(FlightCommand::kHold, FlightMode::kFlying, Delay::kNone).text, "brakes and holds");
  EXPECT_EQ(answer(FlightCommand::kHold, FlightMode::kHolding, Delay::kNone).text, "is holding already");
  EXPECT_EQ(answer(FlightCommand::kHold, FlightMode::kLanded, Delay::kNone).text, "is landed and stays so");
  EXPECT_EQ(answer(FlightCommand::kStart, FlightMode::kLanded, Delay::kNone).text,
            "takes off and goes on with its mission");
  const CommandAnswer refused = answer(FlightCommand::kLand, FlightMode::kAbsent, Delay::kNone);
  EXPECT_FALSE(refused.accepted);
  EXPECT_EQ(refused.text, "cannot land: it has left the swarm or is flown by another system; join first");
  const CommandAnswer lost = answer(FlightCommand::kLand, FlightMode::kFlying, Delay::kOdometryLost);
  EXPECT_TRUE(lost.accepted);
  EXPECT_EQ(lost.text, "brakes and lands; its odometry is lost: once that is back");
}

// Every answer to every command in every mode is a sentence of its own kind, never empty.
TEST(CommandAnswer, IsNeverEmpty) {
  for (const FlightMode mode : kFlightModes) {
    for (const FlightCommand command : kFlightCommands) {
      const FlightTransition change = transition(mode, eventOf(command, SwarmActivity::kHolding));
      const CommandAnswer answer = answerTo(command, mode, change, Delay::kNone);
      EXPECT_FALSE(answer.text.empty());
      EXPECT_EQ(answer.accepted, change.answer != FlightAnswer::kRefused);
      EXPECT_EQ(answer.mode, change.mode);
      EXPECT_EQ(answer.text.find("unknown"), std::string::npos) << answer.text;
    }
  }
}

}  // namespace
}  // namespace swarm_planner
