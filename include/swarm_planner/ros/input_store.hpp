// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "swarm_planner/obstacles/track_memory.hpp"
#include "swarm_planner/ros/odometry_conversion.hpp"
#include "swarm_planner/ros/place_history.hpp"
#include "swarm_planner/ros/track_conversion.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// What is known of one UAV's odometry.
struct UavInput {
  bool received = false;  ///< `sample` holds the newest usable message
  OdometrySample sample;
  double start_yaw = 0.0;  ///< heading in the first usable message [rad]
  std::uint64_t accepted = 0;
  FaultCounts dropped;
  std::string fault;  ///< what is wrong with the newest message; empty if it was usable
};

/// What is known of the obstacle tracks' source.
struct TrackInput {
  bool received = false;
  double stamp = 0.0;     ///< of the newest usable track [s]
  std::size_t known = 0;  ///< tracks in use
  std::uint64_t messages = 0;
  FaultCounts dropped;  ///< tracks, and 1 for each whole message
  std::string last_fault;
  std::uint64_t crowded = 0;  ///< messages that left more tracks than are used
};

/// The newest usable inputs, filled by the threads that receive and read once per cycle. The lock that reading takes is
/// held only while values are copied, so neither side waits for work of the other.
class InputStore {
 public:
  /// `track_timeout` [s]: of TrackMemory. Of more than `max_tracks` tracks the nearest to the UAVs are kept.
  InputStore(std::size_t uavs, double track_timeout, std::size_t max_tracks);

  /// Drops a sample that is older than the one it has: messages may overtake each other.
  void accept(std::size_t uav, const OdometrySample& sample);
  void reject(std::size_t uav, InputFault fault, const std::string& why);
  /// Tracks of several sources, or of an array that does not repeat every obstacle, add up as in TrackMemory.
  /// Sorting them out is done before the lock that fill() takes.
  void accept(TrackBatch batch);
  /// A message of tracks could not even be read.
  void reject(InputFault fault, const std::string& why);

  /// Forgets every sample and track (time has jumped back). Counts stay.
  void clear();

  /// The snapshot at `now` [s], without tracks that are too old. Its time is at least that of the newest sample and
  /// track, which may be ahead of `now` by kFutureTolerance.
  void fill(double now, Snapshot& snapshot);

  std::vector<UavInput> uavs() const;
  /// Where the UAVs were at `t` [s], those that have been measured. Takes a lock that fill() does not take.
  std::vector<Vector3> placesAt(double t) const;
  TrackInput tracks() const;

 private:
  std::vector<Vector3> places() const;

  const std::size_t max_tracks_;
  const double track_timeout_;  ///< [s]
  std::mutex memory_mutex_;     ///< of memory_ and nearest_, held while tracks are sorted out; taken before mutex_
  TrackMemory memory_;
  NearestTracks nearest_;
  mutable std::mutex history_mutex_;  ///< of histories_
  std::vector<PlaceHistory> histories_;
  mutable std::mutex mutex_;  ///< of all below
  std::vector<UavInput> uavs_;
  std::vector<TrackedObstacle> tracks_;  ///< those of memory_
  TrackInput track_input_;
};

}  // namespace swarm_planner
