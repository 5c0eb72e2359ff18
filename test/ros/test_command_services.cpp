// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Breaks for the user: a command that goes to the wrong UAV, or a bad request that is not answered.
#include <gtest/gtest.h>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/ros/command_services.hpp"

namespace swarm_planner {
namespace {

class CommandRequests : public ::testing::Test {
 protected:
  CommandRequests() {
    for (std::size_t uav = 0; uav < planner_.uavCount(); ++uav) {
      names_.push_back(planner_.uavName(uav));
      index_[names_.back()] = uav;
    }
  }

  Command::Response ask(const std::vector<std::string>& uavs, int action) {
    Command::Request request;
    request.uavs = uavs;
    request.action = static_cast<std::uint8_t>(action);
    Command::Response response;
    carryOut(request, index_, planner_, response);
    EXPECT_EQ(response.accepted.size(), response.reasons.size());
    return response;
  }

  SwarmPlanner planner_{makeMission(paperSix(), {}, "paper_six")};
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> index_;
};

using Accepted = std::vector<std::uint8_t>;

TEST_F(CommandRequests, GoToTheUavsThatTheyName) {
  EXPECT_EQ(ask({"uav5", "uav2"}, Command::Request::HOLD).accepted, Accepted({1, 1}));
  for (std::size_t uav = 0; uav < 6; ++uav) {
    EXPECT_EQ(planner_.mode(uav), uav == 1 || uav == 4 ? FlightMode::kHolding : FlightMode::kWaiting);
  }
}

TEST_F(CommandRequests, WithoutNamesGoToAllInTheirOrder) {
  ask({"uav3"}, Command::Request::LEAVE);
  const Command::Response response = ask({}, Command::Request::STOP);
  EXPECT_EQ(response.accepted, Accepted({1, 1, 0, 1, 1, 1}));
  EXPECT_NE(response.reasons[2].find("join first"), std::string::npos);
}

TEST_F(CommandRequests, WithUnknownOrRepeatedNamesAreAnsweredOneByOne) {
  const Command::Response response = ask({"uav7", "uav1", "uav1", ""}, Command::Request::LAND);
  EXPECT_EQ(response.accepted, Accepted({0, 1, 0, 0}));
  EXPECT_EQ(response.reasons[0], "no UAV is called 'uav7'; there are: uav1, uav2, uav3, uav4, uav5, uav6");
  EXPECT_EQ(response.reasons[2], "named more than once; the first time counts");
  EXPECT_EQ(planner_.mode(0), FlightMode::kLanding);
}

TEST_F(CommandRequests, WithAnUnknownActionChangeNothing) {
  for (const int action : {6, 100, 255}) {
    const Command::Response response = ask({}, action);
    EXPECT_EQ(response.accepted, Accepted(6, 0));
    EXPECT_EQ(response.reasons[0], "there is no action " + std::to_string(action) + "; the last one is 5");
  }
  for (std::size_t uav = 0; uav < 6; ++uav) EXPECT_EQ(planner_.mode(uav), FlightMode::kWaiting);
}

TEST_F(CommandRequests, WithNamesOfAnyLengthAreAnsweredBriefly) {
  EXPECT_LT(ask({std::string(10000000, 'x')}, Command::Request::LAND).reasons[0].size(), 300U);
  EXPECT_EQ(ask(std::vector<std::string>(100000, "uav1"), Command::Request::LAND).accepted.size(), 100000U);
}

TEST_F(CommandRequests, OfTheWholeSwarmAreSummedUp) {
  ask({"uav3"}, Command::Request::LEAVE);
  std_srvs::Trigger::Response response;
  summarise("hold", names_, ask({}, Command::Request::HOLD), response);
  EXPECT_TRUE(response.success);
  EXPECT_EQ(response.message.find("hold: accepted by 5 of 6; "), 0U) << response.message;
  EXPECT_NE(response.message.find("uav1 and 4 more: brakes and holds"), std::string::npos) << response.message;
  EXPECT_NE(response.message.find("uav3: cannot hold: it has left"), std::string::npos) << response.message;
  ask({}, Command::Request::LEAVE);
  summarise("hold", names_, ask({}, Command::Request::HOLD), response);
  EXPECT_FALSE(response.success) << "nobody holds";
}

}  // namespace
}  // namespace swarm_planner
