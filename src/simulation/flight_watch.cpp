// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/simulation/flight_watch.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr double kFar = 20.0;         // [m]
constexpr double kReasonTime = 30.0;  // [s]

bool isInside(const Vector3& point, const std::vector<Superellipsoid>& obstacles) {
  return std::any_of(obstacles.begin(), obstacles.end(), [&point](const Superellipsoid& obstacle) {
    return obstacle.distanceLowerBound(point) <= 0.0 && obstacle.sum(point - obstacle.center()) < 1.0;
  });
}

}  // namespace

bool UavFlight::isFar() const { return std::abs(behind_target) > kFar; }

bool UavFlight::hasReason() const { return target_inside_ago && *target_inside_ago <= kReasonTime; }

void FlightWatch::observe(double t, const std::vector<Vector3>& positions, const std::vector<Superellipsoid>& obstacles,
                          const ProgressWatch& progress) {
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    Uav& uav = uavs_[i];
    if (begun_) uav.path_length += (positions[i] - uav.position).norm();
    uav.position = positions[i];
    if (!progress.arrived(i)) {
      uav.arrival_time.reset();
    } else if (!uav.arrival_time) {
      uav.arrival_time = t;
      uav.path_length_at_arrival = uav.path_length;
      uav.position_at_arrival = uav.position;
    }
    const Vector3& target = progress.target(i).p;
    if (isInside(target, obstacles) || (map_ != nullptr && map_->isOccupied(target))) uav.target_inside_at = t;
  }
  time_ = t;
  begun_ = true;
}

UavFlight FlightWatch::flight(std::size_t uav, const ProgressWatch& progress) const {
  const Uav& flown = uavs_[uav];
  UavFlight flight;
  flight.arrived = flown.arrival_time.has_value();
  flight.stuck = progress.stuck(uav);
  flight.arrival_time = flown.arrival_time;
  flight.path_length = flight.arrived ? flown.path_length_at_arrival : flown.path_length;
  flight.remaining = (progress.end(uav) - (flight.arrived ? flown.position_at_arrival : flown.position)).norm();
  flight.lag = progress.lag(uav);
  flight.behind_target = (progress.target(uav).p - flown.position).dot(progress.targetTangent(uav));
  if (flown.target_inside_at) {
    flight.target_inside_ago = time_ - *flown.target_inside_at;
    flight.target_inside = *flight.target_inside_ago == 0.0;
  }
  return flight;
}

}  // namespace swarm_planner
