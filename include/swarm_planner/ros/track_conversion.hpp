// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "swarm_planner/ObstacleTrack.h"
#include "swarm_planner/ObstacleTrackArray.h"
#include "swarm_planner/obstacles/obstacle_track.hpp"
#include "swarm_planner/ros/frame_transformer.hpp"
#include "swarm_planner/ros/input_fault.hpp"

namespace swarm_planner {

/// The usable tracks of a message and what is wrong with the others.
struct TrackBatch {
  static constexpr std::size_t kMostSentences = 5;

  std::vector<TrackedObstacle> tracks;
  FaultCounts dropped;              ///< tracks, and 1 for a whole message
  std::vector<std::string> faults;  ///< of the first that were dropped a sentence each, which names the track

  void drop(InputFault fault, const std::string& sentence);
};

/// Checks tracks and brings them into the planning frame. A bad track is dropped alone: not finite or
/// beyond plausible.hpp, a radius that is not positive, an exponent below 2, an orientation that is none, a negative
/// sigma, an id that came before in the same message. The whole message is dropped if its frame is unknown or its stamp
/// is from the future or older than `timeout` [s]. The core's bodies stand upright: a tilted one is replaced by its
/// bounding sphere.
TrackBatch convertTracks(const ObstacleTrackArray& message, const FrameTransformer& frames, double now, double timeout);

/// One body as a track message, in the frame that it is given in.
ObstacleTrack toMessage(const Superellipsoid& body);

}  // namespace swarm_planner
