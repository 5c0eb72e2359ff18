// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "swarm_planner/Command.h"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// Carries out `request` for the UAVs that it names, all if it names none. Whatever is wrong with it is in the answer.
/// `index`: of each UAV by name.
void carryOut(const Command::Request& request, const std::map<std::string, std::size_t>& index, SwarmPlanner& planner,
              Command::Response& response);

/// The answer of a command to the whole swarm in one text: how many UAVs do what, and each refusal with its reason.
/// Successful if some UAV accepted.
void summarise(const std::string& command, const std::vector<std::string>& names, const Command::Response& answers,
               std_srvs::Trigger::Response& response);

/// The services that command the swarm: start, hold, land, emergency_stop, command. They are served from the global
/// queue, so that none runs beside another or beside the planning cycle.
class CommandServices {
 public:
  /// `planner` must outlive this. `commanded` is called after every command.
  CommandServices(const std::vector<std::string>& uav_names, SwarmPlanner& planner, std::function<void()> commanded);
  CommandServices(const CommandServices&) = delete;
  CommandServices& operator=(const CommandServices&) = delete;

 private:
  void advertiseForAll(ros::NodeHandle& node, const char* name, std::uint8_t action);
  bool command(Command::Request& request, Command::Response& response);

  const std::vector<std::string> names_;
  std::map<std::string, std::size_t> index_;
  SwarmPlanner& planner_;
  const std::function<void()> commanded_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace swarm_planner
