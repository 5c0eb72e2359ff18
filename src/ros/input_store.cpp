// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/input_store.hpp"

#include <algorithm>

#include "swarm_planner/ros/geometry_conversion.hpp"

namespace swarm_planner {

namespace {

constexpr std::size_t kUsualTracks = 256;  // more take memory from the heap, in a thread that no cycle waits for

}  // namespace

InputStore::InputStore(std::size_t uavs, double track_timeout) : uavs_(uavs), tracks_(track_timeout, kUsualTracks) {}

void InputStore::accept(std::size_t uav, const OdometrySample& sample) {
  const std::lock_guard<std::mutex> lock(mutex_);
  UavInput& input = uavs_[uav];
  ++input.accepted;
  input.fault.clear();
  if (!input.received) input.start_yaw = yawOf(sample.orientation);
  if (!input.received || sample.stamp >= input.sample.stamp) input.sample = sample;
  input.received = true;
}

void InputStore::reject(std::size_t uav, OdometryFault fault, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  UavInput& input = uavs_[uav];
  ++input.dropped[static_cast<std::size_t>(fault)];
  input.fault = why;
}

void InputStore::accept(const TrackBatch& batch) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++track_input_.messages;
  track_input_.faults += batch.faults.size();
  if (!batch.faults.empty()) track_input_.last_fault = batch.faults.front();
  if (batch.tracks.empty()) return;
  // All tracks of a batch have its stamp, which has been judged against the clock.
  const double stamp = batch.tracks.front().stamp;
  tracks_.update(batch.tracks, stamp);
  track_input_.stamp = track_input_.received ? std::max(track_input_.stamp, stamp) : stamp;
  track_input_.received = true;
}

void InputStore::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (UavInput& input : uavs_) {
    input.received = false;
    input.fault.clear();
  }
  tracks_.reset();
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
  tracks_.forget(now);
  snapshot.obstacles = tracks_.tracks();
  for (const TrackedObstacle& track : snapshot.obstacles) snapshot.now = std::max(snapshot.now, track.stamp);
}

std::vector<UavInput> InputStore::uavs() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return uavs_;
}

TrackInput InputStore::tracks() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  TrackInput input = track_input_;
  input.known = tracks_.tracks().size();
  return input;
}

}  // namespace swarm_planner
