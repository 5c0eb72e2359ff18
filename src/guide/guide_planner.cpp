// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/guide/guide_planner.hpp"

#include <algorithm>
#include <cmath>

namespace swarm_planner {
namespace {

constexpr std::uint32_t kRenewal = 4;      // rounds until a guide that is clear is compared with a new one
constexpr std::uint32_t kRetry = 5;        // rounds until a search that found nothing is repeated
constexpr std::uint32_t kMapRenewal = 16;  // the same round what a map has, where searches take longer
constexpr std::uint32_t kMapRetry = 20;
constexpr double kMapCell = 1.25;      // of the distance to keep: lattices see doors little wider than twice that
constexpr double kMapRegion = 6.0;     // half extent that what a map has is taken for [m]
constexpr double kLevel = 2.5;         // cells above and below start and goal in a level search
constexpr double kGain = 0.15;         // of the cost, that a new guide saves if it replaces one that is clear
constexpr double kFinest = 30.0;       // cells on the straight line to the goal at most
constexpr double kCoarsest = 10.0;     // at least
constexpr double kCellShare = 0.5;     // of the half width of the narrowest body
constexpr double kLongestTime = 60.0;  // that bodies are predicted for [s]
constexpr int kRings = 32;             // around an end that is not clear
constexpr int kHalvings = 6;           // of the way from one to the next
constexpr double kBeyond = 0.5;        // of the blocked stretch, by which a goal lies beyond it
constexpr double kMargin = 2.0;        // of the region about start and goal, in their distance and what blocks
constexpr int kMostAttempts = 5;
constexpr double kRepairComfort = 2.0;
constexpr double kMissing = 1e6;  // urgency of a UAV without a guide that is clear

Box grown(Box box, double by) {
  box.min -= Vector3::Constant(by);
  box.max += Vector3::Constant(by);
  return box;
}

/// 26 directions, level ones first.
const std::array<Vector3, 26>& directions() {
  static const std::array<Vector3, 26> all = [] {
    std::array<Vector3, 26> list;
    std::size_t count = 0;
    for (const int z : {0, 1, -1}) {
      for (const int x : {1, 0, -1}) {
        for (const int y : {-1, 0, 1}) {
          if (x != 0 || y != 0 || z != 0) list[count++] = Vector3(x, y, z).normalized();
        }
      }
    }
    return list;
  }();
  return all;
}

Box boxOf(const FollowedPath& path, const Vector3& start) {
  Box box;
  box.include(start);
  for (std::size_t i = 0; i < path.count; ++i) box.include(path.points[i]);
  return box;
}

}  // namespace

GuidePlanner::GuidePlanner(const GuideSettings& settings, std::size_t uavs, std::size_t most_bodies)
    : settings_(settings),
      space_(most_bodies),
      traffic_(settings.horizontal, settings.vertical, uavs),
      blockages_(uavs),
      ages_(uavs, 0),
      waits_(uavs, 0) {
  by_x_.reserve(most_bodies);
  boxes_.reserve(most_bodies);
  wants_.reserve(uavs);
}

void GuidePlanner::sortBodies(const GuideScene& scene) {
  boxes_.clear();
  by_x_.clear();
  widest_ = 0.0;
  for (const GuideBody& body : scene.bodies) {
    boxes_.push_back(grown(body.boxUntil(kLongestTime), settings_.comfort));
    by_x_.push_back(static_cast<std::uint32_t>(by_x_.size()));
    widest_ = std::max(widest_, boxes_.back().max.x() - boxes_.back().min.x());
  }
  std::sort(by_x_.begin(), by_x_.end(), [this](std::uint32_t a, std::uint32_t b) {
    return boxes_[a].min.x() != boxes_[b].min.x() ? boxes_[a].min.x() < boxes_[b].min.x() : a < b;
  });
}

void GuidePlanner::gather(const GuideScene& scene, const GuideRequest& request, std::uint32_t uav, const Box& region,
                          double time) {
  space_.clear(request.workspace);
  space_.setMap(scene.map.get(), scene.map_distance);
  const auto first = std::lower_bound(by_x_.begin(), by_x_.end(), region.min.x() - widest_,
                                      [this](std::uint32_t i, double x) { return boxes_[i].min.x() < x; });
  for (auto i = first; i != by_x_.end() && boxes_[*i].min.x() <= region.max.x(); ++i) {
    const GuideBody& body = scene.bodies[*i];
    if (body.uav == uav || (body.uav != GuideBody::kNoUav && request.ignores_uavs)) continue;
    if (!boxes_[*i].near(region, 0.0)) continue;
    if (grown(body.boxUntil(time), settings_.comfort).near(region, 0.0)) space_.add(body);
  }
}

void GuidePlanner::gatherTraffic(const GuideScene& scene, std::uint32_t uav, const Box& region) {
  traffic_.clear(scene.spacing);
  for (std::uint32_t other = 0; other < scene.flights.size(); ++other) {
    if (other != uav && scene.flights[other].box.near(region, 0.0)) traffic_.add(scene.flights[other]);
  }
}

void GuidePlanner::plan(const GuideScene& scene, const std::vector<GuideRequest>& requests,
                        std::vector<GuideAnswer>& answers) {
  expansions_ = searches_ = 0;
  wants_.clear();
  sortBodies(scene);
  for (std::uint32_t uav = 0; uav < requests.size(); ++uav) assess(scene, requests[uav], uav, answers[uav]);
  std::sort(wants_.begin(), wants_.end(), [](const Want& a, const Want& b) {
    return a.urgency != b.urgency ? a.urgency > b.urgency : a.uav < b.uav;
  });
  for (const Want& want : wants_) {
    if (expansions_ >= kRoundBudget) {
      ++waits_[want.uav];
      continue;
    }
    waits_[want.uav] = 0;
    search(scene, requests[want.uav], want, answers[want.uav]);
  }
}

void GuidePlanner::assess(const GuideScene& scene, const GuideRequest& request, std::uint32_t uav,
                          GuideAnswer& answer) {
  const bool is_same = answer.version == request.version;
  answer.version = request.version;
  if (!is_same || !request.wanted) answer.state = GuideState::kNotNeeded;
  if (!request.wanted) return;
  const bool has_guide = answer.state == GuideState::kGuided;
  Box region = boxOf(request.path, request.start);
  for (std::size_t i = 0; has_guide && i < answer.path.count; ++i) region.include(answer.path.points[i]);
  gather(scene, request, uav, region, kLongestTime);
  space_.relieve(request.start);
  const LookAhead look{request.reach, settings_.least_gap};
  const std::optional<Blockage> blockage =
      findBlockage(request.path, request.start, {0.0, request.speed}, look, space_);
  if (!blockage) {
    answer.state = GuideState::kNotNeeded;
    return;
  }
  blockages_[uav] = *blockage;
  if (blockage->in_map) blockages_[uav].smallest = std::min(blockage->smallest, scene.map_distance);
  ++ages_[uav];
  space_.setComfort(-settings_.slack);
  const bool is_clear = has_guide && isClearStill(request, restOf(answer.path, request.start), answer);
  if (is_clear || (has_guide && repair(request, answer))) {
    if (ages_[uav] >= (blockage->in_map ? kMapRenewal : kRenewal))
      wants_.push_back({uav, static_cast<double>(waits_[uav]), true});
    return;
  }
  if (answer.state == GuideState::kNoWay && ages_[uav] < (blockage->in_map ? kMapRetry : kRetry)) return;
  if (answer.state == GuideState::kNotNeeded) answer.state = GuideState::kWaiting;
  wants_.push_back({uav, kMissing + waits_[uav] - blockage->begin / request.speed, false});
}

bool GuidePlanner::isClearStill(const GuideRequest& request, const GuidePath& rest, const GuideAnswer& answer) const {
  const Pace pace{0.0, request.speed};
  if (!isClear(rest, pace, space_)) return false;
  if (!answer.rejoins) return true;
  // On the reference, as far as it is within reach.
  const double flown = rest.length();
  const double first = answer.rejoin - request.path.begin;
  const double last = std::min(first + request.reach - flown, request.path.length());
  TimedPoint from = pace.after(rest.end(), flown);
  for (std::size_t i = 1; i < request.path.count && request.path.ways[i - 1] < last; ++i) {
    if (request.path.ways[i] <= first) continue;
    const double way = std::min(request.path.ways[i], last);
    const TimedPoint to = pace.after(request.path.at(way), flown + way - first);
    if (!space_.isClear(from, to)) return false;
    from = to;
  }
  return true;
}

bool GuidePlanner::repair(const GuideRequest& request, GuideAnswer& answer) {
  const Pace pace{0.0, request.speed};
  // Points go farther out than the pieces between them have to stay.
  space_.setComfort(kRepairComfort * settings_.comfort);
  GuidePath path = restOf(answer.path, request.start);
  double way = 0.0;
  for (std::size_t i = 1; i < path.count; ++i) {
    way += (path.points[i] - path.points[i - 1]).norm();
    const TimedPoint point = pace.after(path.points[i], way);
    if (space_.clearance(point) >= 0.0) continue;
    const bool is_on_reference = answer.rejoins && i + 1 == path.count;
    const std::optional<Vector3> place = nearestClear(point, point.p, settings_.comfort);
    if (is_on_reference || !place) return false;
    path.points[i] = *place;
  }
  space_.setComfort(0.0);
  if (!isClearStill(request, path, answer)) return false;
  space_.setComfort(settings_.comfort);
  traffic_.clear(1.0);
  tighten(path, pace, space_, traffic_);
  answer.path = path;
  answer.branch = request.path.begin;
  ++answer.number;
  return true;
}

std::optional<Vector3> GuidePlanner::nearestClear(const TimedPoint& end, const Vector3& from, double step) const {
  for (int ring = 0; ring <= kRings; ++ring) {
    std::optional<Vector3> best;
    for (const Vector3& direction : directions()) {
      const TimedPoint candidate{end.p + ring * step * direction, end.t};
      if (best && (candidate.p - from).norm() >= (*best - from).norm()) continue;
      if (space_.clearance(candidate) >= 0.0) best = candidate.p;
    }
    if (!best) continue;
    // The ring within was not clear there: as near as 1 / 2^kHalvings of a step.
    Vector3 outside = *best;
    Vector3 inside = ring == 0 ? outside : Vector3(end.p + (ring - 1.0) / ring * (outside - end.p));
    for (int i = 0; ring > 0 && i < kHalvings; ++i) {
      const Vector3 middle = 0.5 * (inside + outside);
      (space_.clearance({middle, end.t}) >= 0.0 ? outside : inside) = middle;
    }
    return outside;
  }
  return std::nullopt;
}

std::optional<GuidePlanner::Goal> GuidePlanner::goalOf(const GuideRequest& request, const Blockage& blockage, bool far,
                                                       double step) const {
  const FollowedPath& path = request.path;
  const bool to_end = far ? blockage.far_to_end : blockage.to_end;
  if (to_end) {
    const double time = (path.length() + (path.points[0] - request.start).norm()) / request.speed;
    const std::optional<Vector3> place = nearestClear({path.at(path.length()), time}, request.start, step);
    if (!place) return std::nullopt;
    return Goal{*place, path.length(), false};
  }
  const double end = far ? blockage.far_end : blockage.near_end;
  const double next = far ? blockage.far_next : blockage.next;
  const double beyond = kBeyond * (end - blockage.begin);
  const double way = next < path.length() ? std::min(end + beyond, 0.5 * (end + next)) : std::min(end + beyond, next);
  return Goal{path.at(way), way, true};
}

void GuidePlanner::search(const GuideScene& scene, const GuideRequest& request, const Want& want, GuideAnswer& answer) {
  ++searches_;
  const Blockage& blockage = blockages_[want.uav];
  // With more distance than demanded, round all that is within reach, if there is such a way. Where the end itself is
  // not clear, as near to it as may be.
  Attempt attempt;
  attempt.comfort = !blockage.far_to_end;
  attempt.far = blockage.far_end != blockage.near_end;
  for (int i = 0; i < kMostAttempts; ++i) {
    const std::optional<Goal> goal = prepare(scene, request, want.uav, attempt);
    SearchOutcome outcome = SearchOutcome::kNoWay;
    if (goal) outcome = lattice_.search(query_, space_, traffic_, found_);
    if (goal) expansions_ += lattice_.expansions();
    if (outcome == SearchOutcome::kFound) {
      tighten(found_, query_.pace, space_, traffic_);
      take(request, want, *goal, answer);
      return;
    }
    attempt = nextAttempt(attempt, outcome, blockage.in_map);
  }
  ages_[want.uav] = 0;
  if (!want.is_renewal) answer.state = GuideState::kNoWay;
}

GuidePlanner::Attempt GuidePlanner::nextAttempt(const Attempt& attempt, SearchOutcome outcome, bool in_map) const {
  Attempt next = attempt;
  next.far = false;
  const bool is_spent = outcome == SearchOutcome::kBudgetSpent;
  if (attempt.far) return next;
  next.comfort = attempt.comfort && is_spent;
  if (in_map) {
    // Doors are as wide as they are: without comfort first, then above and below, then more closely.
    next.level = attempt.level && (attempt.comfort || is_spent);
    if (is_spent) next.cell *= 1.5;
    if (!is_spent && !attempt.comfort && !attempt.level) next.cell *= 0.5;
  } else {
    // A lattice that is too fine for what blocks does not come round it; one that is too coarse sees no gap.
    next.cell *= is_spent ? 2.0 : 0.5;
  }
  return next;
}

void GuidePlanner::shapeQuery(const GuideScene& scene, const Blockage& blockage, const Vector3& towards,
                              const Attempt& attempt) {
  const double distance = std::max((towards - query_.start).norm(), blockage.smallest);
  query_.budget = blockage.in_map ? kMapSearchBudget : kSearchBudget;
  query_.cell = attempt.cell * std::clamp(kCellShare * blockage.smallest, distance / kFinest, distance / kCoarsest);
  if (blockage.in_map) query_.cell = std::min(query_.cell, attempt.cell * kMapCell * scene.map_distance);
  const double largest = blockage.in_map ? std::max(blockage.largest, kMapRegion) : blockage.largest;
  query_.region = Box();
  query_.region.include(query_.start);
  query_.region.include(towards);
  const double low = query_.region.min.z();
  const double high = query_.region.max.z();
  query_.region = grown(query_.region, kMargin * (distance + largest));
  if (!blockage.in_map || !attempt.level) return;
  query_.region.min.z() = low - kLevel * query_.cell;
  query_.region.max.z() = high + kLevel * query_.cell;
}

std::optional<GuidePlanner::Goal> GuidePlanner::prepare(const GuideScene& scene, const GuideRequest& request,
                                                        std::uint32_t uav, const Attempt& attempt) {
  const Blockage& blockage = blockages_[uav];
  const Vector3 towards = request.path.at(attempt.far ? blockage.far_end : blockage.near_end);
  query_.start = request.start;
  query_.pace = {0.0, request.speed};
  shapeQuery(scene, blockage, towards, attempt);
  const double distance = (towards - request.start).norm();
  gather(scene, request, uav, query_.region,
         std::min(kLongestTime, 2.0 * kMargin * std::max(distance, blockage.smallest) / request.speed));
  space_.setComfort(attempt.comfort ? settings_.comfort : 0.0);
  space_.relieve(request.start);
  gatherTraffic(scene, uav, query_.region);
  const std::optional<Goal> goal = goalOf(request, blockage, attempt.far, query_.cell);
  if (goal) query_.goal = goal->p;
  return goal;
}

void GuidePlanner::take(const GuideRequest& request, const Want& want, const Goal& goal, GuideAnswer& answer) {
  ages_[want.uav] = 0;
  const double rejoin = request.path.begin + goal.rejoin;
  if (want.is_renewal) {
    // Each with the way on the reference to where the other one joins it.
    const Pace pace{0.0, request.speed};
    const double last = std::max(rejoin, answer.rejoin);
    const double kept = costOf(restOf(answer.path, request.start), pace, traffic_) + last - answer.rejoin;
    const double renewed = costOf(found_, pace, traffic_) + last - rejoin;
    if (renewed > (1.0 - kGain) * kept) return;
  }
  answer.state = GuideState::kGuided;
  ++answer.number;
  ++answer.course;
  answer.path = found_;
  answer.branch = request.path.begin;
  answer.rejoin = rejoin;
  answer.rejoins = goal.rejoins;
}

}  // namespace swarm_planner
