// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/fault_service.hpp"

#include <ros/console.h>

#include <optional>
#include <utility>

#include "swarm_planner/ros/guarded_input.hpp"
#include "swarm_planner/ros/node_constants.hpp"

namespace swarm_planner {
namespace {

constexpr std::size_t kMostFaultBytes = 4096;

/// Who injects what is not injected here.
std::string whoElse(FaultKind kind) {
  if (concernsVehicles(kind)) return "ask quad_sim_node";
  if (concernsTracks(kind)) return "ask obstacle_sim_node";
  return "kill planner_node and start it again";
}

}  // namespace

bool concernsVehicles(FaultKind kind) { return faultKindInfo(kind).of_uav; }

bool concernsTracks(FaultKind kind) { return kind == FaultKind::kTracksLost || kind == FaultKind::kTracksFlicker; }

FaultService::FaultService(const Mission& mission, FaultInjector& injector, std::function<bool(FaultKind)> injects,
                           std::function<double()> now)
    : injector_(injector), injects_(std::move(injects)), now_(std::move(now)) {
  for (const ScenarioUav& uav : mission.scenario.uavs) uavs_.push_back(uav.name);
  for (const FaultInjection& fault : mission.scenario.faults) {
    if (injects_(fault.kind) || concernsVehicles(fault.kind) || concernsTracks(fault.kind)) continue;
    ROS_WARN("The scenario's fault %s is not injected: %s", faultKindInfo(fault.kind).name,
             whoElse(fault.kind).c_str());
  }
  ros::NodeHandle private_node("~");
  server_ = advertiseGuarded<InjectFault>(
      private_node, kInjectFaultService, kMostFaultBytes,
      [this](InjectFault::Request& request, InjectFault::Response& response) { return serve(request, response); },
      [](InputFault, const std::string& why, InjectFault::Response& response) { response.message = why; });
}

bool FaultService::serve(InjectFault::Request& request, InjectFault::Response& response) {
  FaultInjection given;
  given.uav = request.uav;
  given.at = request.delay;
  given.duration = request.duration;
  given.magnitude = request.magnitude;
  const std::optional<FaultInjection> fault = makeFaultInjection(request.kind, given, uavs_, response.message);
  response.success = false;
  if (!fault) return true;
  if (!injects_(fault->kind)) {
    response.message = request.kind + " is not injected here: " + whoElse(fault->kind);
    return true;
  }
  injector_.schedule(*fault, now_());
  response.success = true;
  response.message = request.kind + (fault->uav.empty() ? "" : " of " + fault->uav) + " from " +
                     std::to_string(now_() + fault->at) + " s on";
  ROS_WARN_STREAM("Injecting " << response.message);
  return true;
}

}  // namespace swarm_planner
