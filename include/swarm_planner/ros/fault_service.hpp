// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <functional>
#include <string>
#include <vector>

#include "swarm_planner/InjectFault.h"
#include "swarm_planner/simulation/fault_injector.hpp"

namespace swarm_planner {

/// The service ~inject_fault of a simulation node. What the node cannot inject is refused with the name of who can.
class FaultService {
 public:
  /// `injects`: the kinds that this node injects; `now` gives the time that the injector goes by [s]. Both and
  /// `injector` must outlive this.
  FaultService(const Mission& mission, FaultInjector& injector, std::function<bool(FaultKind)> injects,
               std::function<double()> now);

 private:
  bool serve(InjectFault::Request& request, InjectFault::Response& response);

  std::vector<std::string> uavs_;
  FaultInjector& injector_;
  std::function<bool(FaultKind)> injects_;
  std::function<double()> now_;
  ros::ServiceServer server_;
};

/// quad_sim_node's kinds: vehicles, their odometry and setpoints.
bool concernsVehicles(FaultKind kind);
/// obstacle_sim_node's kinds.
bool concernsTracks(FaultKind kind);

}  // namespace swarm_planner
