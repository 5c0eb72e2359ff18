// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/command_services.hpp"

#include <ros/console.h>

#include <boost/function.hpp>
#include <set>
#include <utility>

#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"

namespace swarm_planner {
namespace {

static_assert(Command::Request::START == static_cast<int>(FlightCommand::kStart), "service and core must agree");
static_assert(Command::Request::HOLD == static_cast<int>(FlightCommand::kHold), "service and core must agree");
static_assert(Command::Request::LAND == static_cast<int>(FlightCommand::kLand), "service and core must agree");
static_assert(Command::Request::STOP == static_cast<int>(FlightCommand::kStop), "service and core must agree");
static_assert(Command::Request::JOIN == static_cast<int>(FlightCommand::kJoin), "service and core must agree");
static_assert(Command::Request::LEAVE == static_cast<int>(FlightCommand::kLeave), "service and core must agree");

// Tens of thousands of names.
constexpr std::size_t kMostCommandBytes = 1 << 20;
std::string knownNames(const std::map<std::string, std::size_t>& index) {
  constexpr int kMost = 10;
  std::string names;
  int count = 0;
  for (const auto& entry : index) {
    if (++count <= kMost) names += (count > 1 ? ", " : "") + entry.first;
  }
  if (count > kMost) names += " and " + std::to_string(count - kMost) + " more";
  return names;
}

}  // namespace

void carryOut(const Command::Request& request, const std::map<std::string, std::size_t>& index, SwarmPlanner& planner,
              Command::Response& response) {
  std::vector<std::string> names = request.uavs;
  if (names.empty()) {
    for (std::size_t uav = 0; uav < planner.uavCount(); ++uav) names.push_back(planner.uavName(uav));
  }
  const bool is_action = request.action < kFlightCommands.size();
  std::set<std::string> seen;
  for (const std::string& name : names) {
    const auto found = index.find(name);
    CommandAnswer answer;
    if (!is_action) {
      answer.text = "there is no action " + std::to_string(request.action) + "; the last one is " +
                    std::to_string(kFlightCommands.size() - 1);
    } else if (found == index.end()) {
      answer.text = "no UAV is called '" + shortened(name) + "'; there are: " + knownNames(index);
    } else if (!seen.insert(name).second) {
      answer.text = "named more than once; the first time counts";
    } else {
      answer = planner.command(found->second, kFlightCommands[request.action]);
    }
    response.accepted.push_back(answer.accepted ? 1 : 0);
    response.reasons.push_back(answer.text);
  }
}

void summarise(const std::string& command, const std::vector<std::string>& names, const Command::Response& answers,
               std_srvs::Trigger::Response& response) {
  std::size_t accepted = 0;
  std::map<std::string, std::vector<std::string>> by_reason;
  for (std::size_t uav = 0; uav < names.size(); ++uav) {
    accepted += answers.accepted[uav] != 0 ? 1 : 0;
    by_reason[answers.reasons[uav]].push_back(names[uav]);
  }
  response.success = accepted > 0;
  response.message = command + ": accepted by " + std::to_string(accepted) + " of " + std::to_string(names.size());
  for (const auto& [reason, uavs] : by_reason) {
    response.message += "; " + uavs.front();
    if (uavs.size() > 1) response.message += " and " + std::to_string(uavs.size() - 1) + " more";
    response.message += ": " + reason;
  }
}

CommandServices::CommandServices(const std::vector<std::string>& uav_names, SwarmPlanner& planner,
                                 std::function<void()> commanded)
    : names_(uav_names), planner_(planner), commanded_(std::move(commanded)) {
  for (std::size_t uav = 0; uav < names_.size(); ++uav) index_[names_[uav]] = uav;
  ros::NodeHandle node("~");
  advertiseForAll(node, kStartService, Command::Request::START);
  advertiseForAll(node, kHoldService, Command::Request::HOLD);
  advertiseForAll(node, kLandService, Command::Request::LAND);
  advertiseForAll(node, kEmergencyStopService, Command::Request::STOP);
  servers_.push_back(advertiseGuarded<Command>(
      node, kCommandService, kMostCommandBytes,
      [this](Command::Request& request, Command::Response& response) { return command(request, response); },
      [](InputFault, const std::string& why, Command::Response& response) {
        response.accepted.assign(1, 0);
        response.reasons.assign(1, why);
      }));
}

void CommandServices::advertiseForAll(ros::NodeHandle& node, const char* name, std::uint8_t action) {
  const boost::function<bool(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)> serve =
      [this, name, action](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
        Command::Request request;
        request.action = action;
        Command::Response answers;
        carryOut(request, index_, planner_, answers);
        commanded_();
        summarise(name, names_, answers, response);
        ROS_INFO_STREAM(response.message);
        return true;
      };
  servers_.push_back(node.advertiseService(name, serve));
}

bool CommandServices::command(Command::Request& request, Command::Response& response) {
  carryOut(request, index_, planner_, response);
  commanded_();
  constexpr std::size_t kMostLines = 20;
  for (std::size_t i = 0; i < response.reasons.size() && i < kMostLines; ++i) {
    const std::string name = request.uavs.empty() ? names_[i] : shortened(request.uavs[i]);
    ROS_INFO_STREAM("command to " << name << (response.accepted[i] != 0 ? ": " : " refused: ") << response.reasons[i]);
  }
  return true;  // false would drop the reasons
}

}  // namespace swarm_planner
