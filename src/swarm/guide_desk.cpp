// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/guide_desk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swarm_planner {
namespace {

constexpr double kQuietTime = 2.0;     // that a UAV rests before others go round it [s]
constexpr double kQuietShare = 0.25;   // of the pair distance, that a UAV at rest may move
constexpr double kBit = 2.0;           // distances to keep, beyond the horizon's reach
constexpr double kCatchUpSpeed = 0.8;  // of max_speed, of a UAV that lags
constexpr double kLeastSpeed = 0.3;    // of max_speed
constexpr double kComfort = 0.5;       // of the distance to keep, more
constexpr double kSlackShare = 0.5;    // of the tracking margin
constexpr double kPointSpacing = 2.0;  // stages between two points of a flight

double horizonTime(const Parameters& parameters) { return kHorizon * parameters.time.sampling_time; }

double obstacleDistance(const LimitParameters& limits) { return limits.uav_radius + limits.tracking_margin; }

GuideSettings settingsOf(const Parameters& parameters) {
  const LimitParameters& limits = parameters.limits;
  GuideSettings settings;
  settings.horizontal = limits.pair_distance + limits.pair_margin;
  settings.vertical = limits.pair_distance_vertical + limits.pair_margin;
  settings.least_gap = limits.max_speed * parameters.time.sampling_time;
  settings.comfort = kComfort * obstacleDistance(limits);
  settings.slack = kSlackShare * limits.tracking_margin;
  return settings;
}

}  // namespace

GuideDesk::GuideDesk(const Parameters& parameters, const std::optional<Workspace>& workspace, std::size_t uavs,
                     std::size_t max_obstacles)
    : parameters_(parameters),
      workspace_(FlightBounds(parameters, workspace ? &*workspace : nullptr).workspace),
      requests_(uavs),
      answers_(uavs),
      quiet_since_(uavs, 0.0),
      planner_(settingsOf(parameters), uavs, max_obstacles + 2 * uavs) {
  scene_.bodies.reserve(max_obstacles + 2 * uavs);
  scene_.flights.resize(uavs);
  scene_.map_distance = obstacleDistance(parameters.limits);
  scene_.spacing = kPointSpacing * parameters.time.sampling_time;
}

void GuideDesk::takeAnswers(std::vector<UavRecord>& uavs) {
  if (turn_.load(std::memory_order_acquire) != Turn::kAnswered) return;
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    if (requests_[i].wanted) uavs[i].guide.take(answers_[i], followedTarget(uavs[i]).target);
  }
  turn_.store(Turn::kCycle, std::memory_order_relaxed);
}

void GuideDesk::ask(double epoch, const std::vector<TrackedObstacle>& tracks, const std::vector<ForeignBody>& foreign,
                    const std::shared_ptr<const VoxelMap>& map, std::vector<UavRecord>& uavs) {
  if (turn_.load(std::memory_order_relaxed) != Turn::kCycle) return;
  // What is found is used a cycle later.
  time_zero_ = epoch + parameters_.time.cycle_period;
  scene_.bodies.clear();
  if (scene_.map != map) {
    last_map_ = std::move(scene_.map);
    scene_.map = parameters_.limits.avoidance ? map : nullptr;
  }
  for (const TrackedObstacle& track : tracks)
    addObstacle(track.shape, track.stamp, inflationOf(track, parameters_.input));
  for (const ForeignBody& body : foreign) addObstacle(body.shape, body.stamp, body.inflation);
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    addUav(i, epoch, uavs[i]);
    fillRequest(uavs[i], requests_[i]);
  }
  turn_.store(Turn::kAsked, std::memory_order_release);
}

bool GuideDesk::search() {
  Turn asked = Turn::kAsked;
  if (!turn_.compare_exchange_strong(asked, Turn::kSearch, std::memory_order_acquire)) return false;
  last_map_.reset();
  planner_.plan(scene_, requests_, answers_);
  turn_.store(Turn::kAnswered, std::memory_order_release);
  return true;
}

void GuideDesk::addObstacle(const Superellipsoid& shape, double stamp, const TrackInflation& inflation) {
  if (scene_.bodies.size() == scene_.bodies.capacity()) return;
  const double age = time_zero_ - stamp;
  GuideBody body;
  body.shape = shape.movedBy(age).atLevel(std::exp(parameters_.cost.epsilon_s));
  const double inflated = inflation.at(age);
  body.distance = obstacleDistance(parameters_.limits) + inflated;
  body.growth_rate = inflation.growth_rate;
  body.growth_limit = inflation.at(inflation.growth_time) - inflated;
  scene_.bodies.push_back(body);
}

void GuideDesk::addUav(std::size_t uav, double epoch, const UavRecord& record) {
  PlannedFlight& flight = scene_.flights[uav];
  flight.box = Box();
  if (record.motions.empty()) return;
  const CommittedMotion& motion = record.motions.newest();
  const LimitParameters& limits = parameters_.limits;
  const bool is_quiet = (motion.box().max - motion.box().min).norm() < kQuietShare * limits.pair_distance;
  if (!is_quiet) quiet_since_[uav] = epoch;
  if (epoch - quiet_since_[uav] >= kQuietTime && scene_.bodies.size() < scene_.bodies.capacity()) {
    const double horizontal = limits.pair_distance + limits.pair_margin;
    const double vertical = limits.pair_distance_vertical + limits.pair_margin;
    GuideBody body;
    body.shape = Superellipsoid(0, motion.restingPlace(), Vector3(horizontal, horizontal, vertical),
                                Vector3::Constant(2.0), 0.0, Vector3::Zero());
    body.uav = static_cast<std::uint32_t>(uav);
    scene_.bodies.push_back(body);
    return;
  }
  for (std::size_t k = 0; k < PlannedFlight::kPoints; ++k) {
    flight.points[k] = motion.at(time_zero_ + static_cast<double>(k) * scene_.spacing).p;
    flight.box.include(flight.points[k]);
  }
}

void GuideDesk::fillRequest(UavRecord& record, GuideRequest& request) const {
  request.wanted = parameters_.limits.guide && parameters_.limits.avoidance && isGuidable(record.task) &&
                   record.planned && !record.unseen;
  if (!request.wanted) return;
  const FollowedTarget followed = followedTarget(record);
  const MovingTarget& target = followed.target;
  const double max_speed = parameters_.limits.max_speed;
  request.version = record.guide.version();
  request.start = record.motions.newest().at(time_zero_).p;
  const double foot = target.path.nearest(request.start, followed.progress).arc_length;
  request.path.assign(target.path, foot);
  const double reach = max_speed * (horizonTime(parameters_) + parameters_.time.sampling_time) +
                       kBit * obstacleDistance(parameters_.limits);
  request.reach = std::clamp(target.at(time_zero_ + horizonTime(parameters_)).arc_length - foot, 0.0, reach);
  const double lag = target.at(time_zero_).arc_length - foot;
  request.speed = lag > max_speed * parameters_.time.sampling_time
                      ? kCatchUpSpeed * max_speed
                      : std::clamp(target.speed, kLeastSpeed * max_speed, max_speed);
  request.workspace = workspace_;
  request.ignores_uavs = parameters_.limits.right_of_way && time_zero_ < record.traffic.jammed_until;
}

}  // namespace swarm_planner
