// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <string>

namespace swarm_planner {

// Names are relative, so that launch files can remap them and push the nodes into a namespace; "~" marks those under
// the node's private name. Names of UAV topics are parameters (see node_options.hpp).
constexpr char kObstacleTracksTopic[] = "obstacle_tracks";
constexpr char kOctomapBinaryTopic[] = "octomap_binary";  // as octomap_server has it
constexpr char kOctomapFullTopic[] = "octomap_full";      // as octomap_server has it
constexpr char kMapCloudTopic[] = "map_cloud";
constexpr char kPlansTopic[] = "plans";                        // ~
constexpr char kStatusTopic[] = "status";                      // ~
constexpr char kMarkersTopic[] = "markers";                    // ~
constexpr char kMapMarkersTopic[] = "map_markers";             // ~
constexpr char kSetReferenceService[] = "set_reference";       // ~
constexpr char kInjectFaultService[] = "inject_fault";         // ~
constexpr char kStartService[] = "start";                      // ~
constexpr char kHoldService[] = "hold";                        // ~
constexpr char kLandService[] = "land";                        // ~
constexpr char kEmergencyStopService[] = "emergency_stop";     // ~
constexpr char kCommandService[] = "command";                  // ~
constexpr char kPlannerStatusTopic[] = "planner_node/status";  // kStatusTopic as other nodes see it
constexpr char kClockTopic[] = "/clock";                       // absolute by ROS convention

constexpr char kTfTopic[] = "/tf";               // as tf2 has it
constexpr char kTfStaticTopic[] = "/tf_static";  // as tf2 has it

constexpr char kDefaultOdometryTopic[] = "{uav}/odometry";
constexpr char kDefaultTrajectoryTopic[] = "{uav}/command/trajectory";
constexpr char kUavPlaceholder[] = "{uav}";
constexpr char kBaseLinkFrame[] = "{uav}/base_link";

// Only the newest odometry, setpoints and status are of use; tracks of several sources share a topic.
constexpr std::uint32_t kOdometryQueueSize = 1;
constexpr std::uint32_t kTrajectoryQueueSize = 1;
constexpr std::uint32_t kObstacleTracksQueueSize = 10;
constexpr std::uint32_t kMapQueueSize = 1;
constexpr std::uint32_t kMapCloudQueueSize = 5;
constexpr std::uint32_t kPlansQueueSize = 1;
constexpr std::uint32_t kStatusQueueSize = 10;
constexpr std::uint32_t kMarkersQueueSize = 1;
constexpr std::uint32_t kClockQueueSize = 1;

constexpr std::uint32_t kTfQueueSize = 100;

// Longer messages are not read [bytes]. They leave room for names and for sources that fill every field.
constexpr std::uint32_t kMostOdometryBytes = 4096;
constexpr std::uint32_t kMostTrackBytes = 16000000;        // 100,000 tracks, of which max_tracks are used
constexpr std::uint32_t kMostMapMessageBytes = 200000000;  // 30 million voxels in full
constexpr std::uint32_t kMostTfBytes = 1000000;            // 7,000 transforms with short names
constexpr std::uint32_t kMostTrajectoryBytes = 8000000;    // 40,000 points
constexpr std::uint32_t kMostReferenceBytes = 300000;      // kMostPathPoints points, and names
constexpr std::uint32_t kMostStatusBytesPerUav = 2048;

/// Between two messages of a kind to the console [s] of wall time.
constexpr double kWarningPeriod = 5.0;

/// Clocks of different computers and the order in which /clock and messages arrive let a stamp lie so far in the
/// future without being wrong [s].
constexpr double kFutureTolerance = 0.1;

/// The topic or frame of a UAV: `pattern` with every "{uav}" replaced by its name.
inline std::string nameForUav(std::string pattern, const std::string& uav) {
  const std::string placeholder = kUavPlaceholder;
  for (auto at = pattern.find(placeholder); at != std::string::npos; at = pattern.find(placeholder, at + uav.size())) {
    pattern.replace(at, placeholder.size(), uav);
  }
  return pattern;
}

}  // namespace swarm_planner
