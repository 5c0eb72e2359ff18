// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/input_store.hpp"

#include <algorithm>

#include "swarm_planner/ros/geometry_conversion.hpp"

namespace swarm_planner {

InputStore::InputStore(std::size_t uavs, double track_timeout, std::size_t max_tracks)
    : max_tracks_(max_tracks),
      track_timeout_(track_timeout),
      memory_(track_timeout, max_tracks, uavs),
      nearest_(uavs, max_tracks),
      histories_(uavs),
      uavs_(uavs) {
  tracks_.reserve(max_tracks);
}

void InputStore::accept(std::size_t uav, const OdometrySample& sample) {
  {
    const std::lock_guard<std::mutex> lock(history_mutex_);
    histories_[uav].add(sample.stamp, sample.p, sample.v);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  UavInput& input = uavs_[uav];
  if (input.received && sample.stamp < input.sample.stamp) {
    input.dropped.add(InputFault::kOutOfOrder);
    return;
  }
  ++input.accepted;
  input.fault.clear();
  if (!input.received) input.start_yaw = yawOf(sample.orientation);
  input.sample = sample;
  input.received = true;
}

void InputStore::reject(std::size_t uav, InputFault fault, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  UavInput& input = uavs_[uav];
  input.dropped.add(fault);
  input.fault = why;
}

std::vector<Vector3> InputStore::places() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Vector3> places;
  for (const UavInput& uav : uavs_) {
    if (uav.received) places.push_back(uav.sample.p);
  }
  return places;
}

void InputStore::accept(TrackBatch batch) {
  const std::lock_guard<std::mutex> memory_lock(memory_mutex_);
  std::size_t crowded_out = 0;
  // All tracks of a batch have its stamp, which has been judged against the clock.
  const double stamp = batch.tracks.empty() ? 0.0 : batch.tracks.front().stamp;
  if (!batch.tracks.empty()) {
    if (batch.tracks.size() > max_tracks_) crowded_out += nearest_.keep(max_tracks_, places(), batch.tracks);
    memory_.update(batch.tracks, stamp);
    if (memory_.tracks().size() > max_tracks_) crowded_out += memory_.keepNearest(places());
    batch.dropped.add(InputFault::kTooMany, crowded_out);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  ++track_input_.messages;
  track_input_.dropped.add(batch.dropped);
  if (!batch.faults.empty()) track_input_.last_fault = batch.faults.front();
  if (crowded_out > 0) ++track_input_.crowded;
  if (batch.tracks.empty()) return;
  tracks_ = memory_.tracks();
  track_input_.stamp = track_input_.received ? std::max(track_input_.stamp, stamp) : stamp;
  track_input_.received = true;
}

void InputStore::reject(InputFault fault, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  track_input_.dropped.add(fault);
  track_input_.last_fault = why;
}

void InputStore::clear() {
  const std::lock_guard<std::mutex> memory_lock(memory_mutex_);
  memory_.reset();
  {
    const std::lock_guard<std::mutex> history_lock(history_mutex_);
    for (PlaceHistory& history : histories_) history.clear();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  for (UavInput& input : uavs_) {
    input.received = false;
    input.fault.clear();
  }
  tracks_.clear();
  track_input_.received = false;
}

void InputStore::fill(double now, Snapshot& snapshot) {
  const std::lock_guard<std::mutex> lock(mutex_);
  snapshot.now = now;
  snapshot.uavs.resize(uavs_.size());
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    const UavInput& input = uavs_[i];
    UavMeasurement& measurement = snapshot.uavs[i];
    measurement.received = input.received;
    measurement.stamp = input.sample.stamp;
    measurement.p = input.sample.p;
    measurement.v = input.sample.v;
    if (input.received) snapshot.now = std::max(snapshot.now, input.sample.stamp);
  }
  tracks_.erase(
      std::remove_if(tracks_.begin(), tracks_.end(),
                     [this, now](const TrackedObstacle& track) { return now - track.stamp > track_timeout_; }),
      tracks_.end());
  snapshot.obstacles = tracks_;
  for (const TrackedObstacle& track : snapshot.obstacles) snapshot.now = std::max(snapshot.now, track.stamp);
}

std::vector<UavInput> InputStore::uavs() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return uavs_;
}

std::vector<Vector3> InputStore::placesAt(double t) const {
  const std::lock_guard<std::mutex> lock(history_mutex_);
  std::vector<Vector3> places;
  for (const PlaceHistory& history : histories_) {
    if (const std::optional<Vector3> place = history.at(t)) places.push_back(*place);
  }
  return places;
}

TrackInput InputStore::tracks() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  TrackInput input = track_input_;
  input.known = tracks_.size();
  return input;
}

}  // namespace swarm_planner
