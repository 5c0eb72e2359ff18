// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/right_of_way.hpp"

#include <algorithm>
#include <limits>

namespace swarm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 0.2;        // of having arrived where the scenario has none [m]
constexpr double kPatientStages = 10.0;   // half a horizon without progress
constexpr double kImpatience = 0.4;       // of the patience, once a UAV has been held up
constexpr double kHardlyMoved = 0.25;     // of the pair distance
constexpr double kLookAhead = 3.0;        // spacings of its way on which a UAV looks who stands there
constexpr double kWayLength = 40.0;       // spacings of a way in which it can be passed
constexpr double kInTheWay = 0.95;        // of the spacing: who only touches the way is not in it
constexpr double kNearer = 0.05;          // spacings; those beside one end are about as far from it
constexpr double kPast = 1.2;             // spacings behind a place at which a UAV is past it
constexpr double kLongest = 4.0;          // patiences without progress after which it is not waited for any longer
constexpr double kMostInsistence = 32.0;  // times the patience
constexpr int kSearchesPerCycle = 8;
constexpr double kAsideSpeed = 0.5;  // of the most speed

/// Where it is on its motion: without the noise of the measurement.
Vector3 placeOf(const UavRecord& uav, double epoch) { return uav.motions.flown().at(epoch).p; }

Vector3 endOf(const UavRecord& uav) { return uav.reference.path.at(uav.reference.path.length()).position; }

}  // namespace

void reportTraffic(const TrafficState& traffic, UavReport& report) {
  if (report.reason != Reason::kNone) return;
  switch (traffic.courtesy) {
    case Courtesy::kNone:
      return;
    case Courtesy::kGivesWay:
      report.reason = Reason::kGivesWay;
      break;
    case Courtesy::kWaits:
      report.reason = Reason::kWaits;
      break;
    case Courtesy::kParked:
      report.reason = Reason::kParked;
      break;
  }
  report.partner = traffic.partner;
}

RightOfWay::RightOfWay(const Mission& mission, const Parameters& parameters)
    : parameters_(parameters),
      tolerance_(mission.scenario.end.all_at_goal ? mission.scenario.end.tolerance : kTolerance),
      patience_(kPatientStages * parameters.time.sampling_time),
      wayside_(parameters, mission.scenario.workspace, mission.scenario.uavs.size(), maxTracks(mission)) {
  held_up_.reserve(mission.scenario.uavs.size());
  blockers_.reserve(mission.scenario.uavs.size());
}

void RightOfWay::direct(double epoch, const std::vector<TrackedObstacle>& obstacles, const std::vector<Reason>& judged,
                        const NeighbourLists& neighbours, std::vector<UavRecord>& uavs, const VoxelMap* map) {
  if (!parameters_.limits.right_of_way) return;
  last_epoch_ = epoch_;
  epoch_ = epoch;
  uavs_ = &uavs;
  held_up_.clear();
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    if (watch(i, judged[i])) held_up_.push_back(i);
  }
  if (held_up_.empty()) return;
  std::sort(held_up_.begin(), held_up_.end(), [this](std::size_t a, std::size_t b) {
    const Rank first = rankOf(a);
    const Rank second = rankOf(b);
    // A UAV comes before those that give way with its rank.
    if (first.uav == second.uav) return (first.uav == a) != (second.uav == b) ? first.uav == a : a < b;
    return first.precedes(second);
  });
  wayside_.begin(obstacles, epoch, map);
  searches_ = 0;
  for (const std::size_t i : held_up_) resolve(i, neighbours);
}

bool RightOfWay::watch(std::size_t i, const Reason& judged) {
  UavRecord& uav = (*uavs_)[i];
  TrafficState& traffic = uav.traffic;
  const bool flies = uav.task.mode == FlightMode::kFlying && uav.planned && !uav.motions.empty();
  if (!flies || judged != Reason::kNone) {
    traffic.forget(epoch_);
    return false;
  }
  traffic.takes_part = true;
  if (traffic.gives_way && isInVain(uav)) {
    // Whoever was to pass does not come past, and would ask for the same again: it is for another one to be first.
    (*uavs_)[traffic.senior].traffic.since = epoch_;
    traffic.leaveAside();
  } else if (traffic.gives_way && isOver(uav)) {
    traffic.leaveAside();
  }
  traffic.courtesy = traffic.gives_way ? Courtesy::kGivesWay : Courtesy::kNone;
  traffic.partner = traffic.beneficiary;
  const FollowedTarget followed = followedTarget(uav);
  const Vector3 place = placeOf(uav, epoch_);
  const bool is_there = (followed.target.at(epoch_).p - place).norm() <= tolerance_;
  const bool moves = (place - traffic.anchor).norm() > kHardlyMoved * parameters_.limits.pair_distance;
  if (is_there || moves || !traffic.is_anchored) {
    traffic.is_anchored = true;
    traffic.anchor = place;
    traffic.anchored_since = epoch_;
  }
  if (is_there && !traffic.gives_way) traffic.since = epoch_;
  const double patience = epoch_ < traffic.jammed_until ? kImpatience * patience_ : patience_;
  const bool is_held_up = epoch_ - traffic.anchored_since >= patience;
  if (is_held_up) traffic.jammed_until = epoch_ + kLongest * patience_;
  return is_held_up;
}

bool RightOfWay::isOver(const UavRecord& uav) const {
  const TrafficState& traffic = uav.traffic;
  const UavRecord& other = (*uavs_)[traffic.beneficiary];
  const TrafficState& its = other.traffic;
  // Its own rank has begun anew: it has arrived, or stays where it is.
  if (!its.takes_part || its.since > traffic.asked_at) return true;
  if (traffic.is_chained != its.gives_way) return true;
  const double progress = its.gives_way ? its.aside_progress : other.progress;
  return progress >= traffic.passed_at;
}

bool RightOfWay::isInVain(const UavRecord& uav) const {
  const TrafficState& traffic = uav.traffic;
  const double longest = kLongest * patience_;
  const double stands_since = (*uavs_)[traffic.beneficiary].traffic.anchored_since;
  return epoch_ - traffic.asked_at > longest && epoch_ - stands_since > longest;
}

RightOfWay::Rank RightOfWay::rankOf(std::size_t i) const {
  const TrafficState& traffic = (*uavs_)[i].traffic;
  const std::size_t senior = traffic.gives_way ? traffic.senior : i;
  return {(*uavs_)[senior].traffic.since, senior};
}

Way RightOfWay::wayOf(std::size_t i) const {
  UavRecord& uav = (*uavs_)[i];
  const FollowedTarget followed = followedTarget(uav);
  const Vector3 place = placeOf(uav, epoch_);
  const double foot =
      followed.on_path ? followed.progress : followed.target.path.nearest(place, 0.0, kInfinity).arc_length;
  return {followed.target, place, foot, epoch_};
}

bool RightOfWay::isSettled(const TrafficState& traffic) const {
  return traffic.takes_part && !traffic.gives_way && traffic.since >= last_epoch_;
}

bool RightOfWay::sharesEnd(std::size_t i, std::size_t j) const {
  const UavRecord& uav = (*uavs_)[i];
  const UavRecord& other = (*uavs_)[j];
  const PairSpacing& spacing = wayside_.spacing();
  if (!isSettled(other.traffic) || spacing.gauge(endOf(uav) - endOf(other)) >= 1.0) return false;
  // Whoever is nearer to where all want to be has not found its end taken, though others beside keep it from it.
  return spacing.gauge(placeOf(other, epoch_) - endOf(other)) <
         spacing.gauge(placeOf(uav, epoch_) - endOf(uav)) + kNearer;
}

void RightOfWay::findBlockers(std::size_t i, const Way& way, const NeighbourLists& neighbours) {
  blockers_.clear();
  const PairSpacing& spacing = wayside_.spacing();
  const double length = kLookAhead * spacing.horizontal;
  for (const std::uint32_t j : neighbours.of(i)) {
    const UavRecord& other = (*uavs_)[j];
    if (other.motions.empty()) continue;
    const Vector3 place = other.traffic.takes_part ? placeOf(other, epoch_) : other.motions.newest().restingPlace();
    if (!way.isBlockedAt(place, length, kInTheWay, spacing)) continue;
    blockers_.push_back({j, (place - way.begin()).norm()});
  }
  std::sort(blockers_.begin(), blockers_.end(), [](const Blocker& a, const Blocker& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.uav < b.uav;
  });
}

void RightOfWay::resolve(std::size_t i, const NeighbourLists& neighbours) {
  TrafficState& traffic = (*uavs_)[i].traffic;
  const Way way = wayOf(i);
  findBlockers(i, way, neighbours);
  if (blockers_.empty()) {
    // What holds it up is no UAV, and it stays where it is: nobody need wait for it. Unless others have only just left.
    if (!traffic.gives_way && epoch_ - traffic.blocked_at >= patience_) traffic.since = epoch_;
    return;
  }
  traffic.blocked_at = epoch_;
  if (!traffic.gives_way) {
    for (const Blocker& blocker : blockers_) {
      if (!sharesEnd(i, blocker.uav)) continue;
      traffic.courtesy = Courtesy::kParked;
      traffic.partner = blocker.uav;
      traffic.since = epoch_;
      return;
    }
    traffic.courtesy = Courtesy::kWaits;
    traffic.partner = blockers_.front().uav;
  }
  for (const Blocker& blocker : blockers_) {
    if (!mayAsk(i, blocker.uav)) continue;
    if (ask(i, blocker.uav, neighbours)) continue;
    // It has nowhere to go. If it wants to come this way, it is for this one to leave, this once.
    const bool comes_this_way = !isSettled((*uavs_)[blocker.uav].traffic) && !givesWayTo(blocker.uav, i);
    if (!traffic.gives_way && comes_this_way && ask(blocker.uav, i, neighbours)) return;
  }
}

bool RightOfWay::mayAsk(std::size_t i, std::size_t j) const {
  const UavRecord& uav = (*uavs_)[i];
  const TrafficState& other = (*uavs_)[j].traffic;
  if (!other.takes_part || searches_ >= kSearchesPerCycle || epoch_ < other.next_search) return false;
  const bool insists = epoch_ - uav.traffic.anchored_since >= uav.traffic.insistence * patience_;
  if (isSettled(other) && !insists) return false;
  if (givesWayTo(i, j)) return false;
  const Rank mine = rankOf(i);
  return mine.uav != j && mine.precedes(rankOf(j));
}

bool RightOfWay::givesWayTo(std::size_t i, std::size_t j) const {
  for (std::size_t steps = 0; steps < uavs_->size(); ++steps) {
    const TrafficState& traffic = (*uavs_)[i].traffic;
    if (!traffic.gives_way) return false;
    i = traffic.beneficiary;
    if (i == j) return true;
  }
  return false;
}

bool RightOfWay::ask(std::size_t i, std::size_t j, const NeighbourLists& neighbours) {
  TrafficState& mine = (*uavs_)[i].traffic;
  UavRecord& other = (*uavs_)[j];
  TrafficState& its = other.traffic;
  const Rank rank = rankOf(i);
  wayside_.forgetOthers();
  for (const std::uint32_t k : neighbours.of(j)) {
    const UavRecord& third = (*uavs_)[k];
    if (third.motions.empty()) continue;
    const bool may_be_asked = k != i && third.traffic.takes_part && rank.uav != k && rank.precedes(rankOf(k));
    wayside_.addOther(third.motions.newest().restingPlace(), may_be_asked);
  }
  const Vector3 place = placeOf(other, epoch_);
  const Way way = wayOf(i);
  const Way seniors = wayOf(rank.uav);
  Wayside::Request request;
  request.from = place;
  request.wanted = endOf(other);
  request.way = &way;
  request.second = rank.uav != i ? &seniors : nullptr;
  ++searches_;
  const std::optional<WayAside> aside = wayside_.find(request);
  if (!aside) {
    its.next_search = epoch_ + patience_;
    return false;
  }
  if (isSettled(its)) mine.insistence = std::min(2.0 * mine.insistence, kMostInsistence);
  its.gives_way = true;
  its.beneficiary = i;
  its.senior = rank.uav;
  its.is_chained = mine.gives_way;
  its.asked_at = epoch_;
  const double spacing = wayside_.spacing().horizontal;
  its.passed_at = way.arcOf(place, kWayLength * spacing) + kPast * spacing;
  its.aside.path.assign(aside->points.data(), aside->count);
  its.aside.start = 0.0;
  its.aside.speed = kAsideSpeed * parameters_.limits.max_speed;
  its.aside.time_zero = epoch_;
  its.on_aside_path = false;
  its.is_anchored = false;
  its.courtesy = Courtesy::kGivesWay;
  its.partner = i;
  return true;
}

}  // namespace swarm_planner
