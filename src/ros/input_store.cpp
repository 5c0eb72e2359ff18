// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/input_store.hpp"

#include <algorithm>

#include "swarm_planner/ros/geometry_conversion.hpp"

namespace swarm_planner {

InputStore::InputStore(std::size_t uavs, double track_timeout) : track_timeout_(track_timeout), uavs_(uavs) {}

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
  for (const TrackedObstacle& track : batch.tracks) {
    const auto [entry, added] = tracks_.try_emplace(track.shape.id(), track);
    if (!added && track.stamp >= entry->second.stamp) entry->second = track;
    track_input_.stamp = track_input_.received ? std::max(track_input_.stamp, track.stamp) : track.stamp;
    track_input_.received = true;
  }
}

void InputStore::clear() {
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
  snapshot.obstacles.clear();
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    if (now - entry->second.stamp > track_timeout_) {
      entry = tracks_.erase(entry);
    } else {
      snapshot.obstacles.push_back(entry->second);
      ++entry;
    }
  }
}

std::vector<UavInput> InputStore::uavs() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return uavs_;
}

TrackInput InputStore::tracks() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  TrackInput input = track_input_;
  input.known = tracks_.size();
  return input;
}

}  // namespace swarm_planner
