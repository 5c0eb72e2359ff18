// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/takeover.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/neighbour_lists.hpp"
#include "swarm_planner/swarm/plan_start.hpp"
#include "swarm_planner/swarm/stopping.hpp"
#include "swarm_planner/swarm/uav_record.hpp"

namespace swarm_planner {
namespace {

constexpr double kBoundSlack = 0.1;  // of a bound, by which an observed state may exceed it
constexpr double kDistinct = 0.1;  // after their epoch, new plans differ from those before enough to be told apart [s]
constexpr double kMoved = 0.5;     // a UAV so far from a motion does not fly it [m]
constexpr double kMovedSpeed = 1.5;     // nor one whose velocity differs so much [m/s]
constexpr double kFootWindow = 5.0;     // of arc length to look for the foot in, beyond what can have been flown [m]
constexpr double kSettlingTimes = 2.0;  // tracking_time, from the first plan on, until a vehicle may be on it
constexpr double kAtRest = 0.25;        // slower UAVs rest [m/s]

/// The parabola through the velocities of three measurements: acceleration and jerk at the last one.
struct Parabola {
  Vector3 a = Vector3::Zero();
  Vector3 j = Vector3::Zero();
};

Vector3 limited(const Vector3& x, double most) { return x.norm() > most ? Vector3(most / x.norm() * x) : x; }

Parabola fit(const UavMeasurement& x0, const UavMeasurement& x1, const UavMeasurement& x2,
             const LimitParameters& limits) {
  const Vector3 first = (x1.v - x0.v) / (x1.stamp - x0.stamp);
  const Vector3 second = (x2.v - x1.v) / (x2.stamp - x1.stamp);
  Parabola parabola;
  // Motions end in a rest for good: a UAV that has rested does not set out without a planner, it has been pushed.
  const bool has_rested = std::max(x0.v.norm(), x1.v.norm()) < kAtRest;
  if (has_rested && x2.v.norm() > Takeover::kHovering) return parabola;
  parabola.j = limited(2.0 / (x2.stamp - x0.stamp) * (second - first), limits.max_jerk);
  parabola.a = limited(second + 0.5 * (x2.stamp - x1.stamp) * parabola.j, limits.max_acceleration);
  return parabola;
}

/// Whether the UAV is about where a motion that a planner before has left puts it.
bool isFlown(const UavMeasurement& measurement, const MotionMemory& motions) {
  const std::optional<KinematicState> expected = motions.expectedAt(measurement.stamp);
  return expected && (measurement.p - expected->p).norm() <= kMoved &&
         (measurement.v - expected->v).norm() <= kMovedSpeed;
}

void resumeMission(double epoch, const Parameters& parameters, bool in_flight, UavRecord& record) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Beginning& left = record.beginning;
  MovingTarget& reference = record.reference;
  const Vector3& p = record.start.p;
  if (left.is_left && !left.on_reference) return;
  if (left.is_left) {
    // The target keeps its lead over the UAV, but comes no farther than it would have come undisturbed.
    const double window = kFootWindow + parameters.limits.max_speed * std::max(epoch - left.epoch, 0.0);
    record.progress = reference.path.nearest(p, left.progress, window).arc_length;
    record.on_reference = true;
    const double undisturbed = left.target + reference.speed * std::max(epoch - left.epoch, 0.0);
    const double lead = left.target - left.progress;
    reference.start = std::max(record.given_start, std::min(record.progress + lead, undisturbed));
  } else if (in_flight || (p - left.home).norm() > Takeover::kAtHome) {
    reference.start = std::max(record.given_start, reference.path.nearest(p, 0.0, kInfinity).arc_length);
  }
  reference.time_zero = epoch;
}

}  // namespace

void ObservedFlight::add(const UavMeasurement& measurement) {
  if (count_ > 0 && measurement.stamp <= stamp()) return;
  if (count_ > 0 && measurement.stamp > stamp() + kLongestGap) clear();
  if (count_ == samples_.size()) {
    std::rotate(samples_.begin(), samples_.begin() + 1, samples_.end());
    --count_;
  }
  samples_[count_++] = measurement;
}

KinematicState ObservedFlight::state(const LimitParameters& limits) const {
  const UavMeasurement& newest = samples_[count_ - 1];
  KinematicState state{newest.p, newest.v, Vector3::Zero()};
  if (count_ == samples_.size()) state.a = fit(samples_[0], samples_[1], samples_[2], limits).a;
  return state;
}

Vector3 ObservedFlight::jerk(const LimitParameters& limits) const {
  if (count_ < samples_.size()) return Vector3::Zero();
  return fit(samples_[0], samples_[1], samples_[2], limits).j;
}

void assumeBraking(const ObservedFlight& flight, double epoch, const Parameters& parameters, MotionMemory& motions) {
  StopManoeuvre past;
  past.stages = 1;
  past.dt = std::max(epoch - flight.stamp(), CommittedMotion::kTimeTolerance);
  past.knots[0] = flight.state(parameters.limits);
  past.knots[1] = propagate(past.knots[0], flight.jerk(parameters.limits), past.dt);
  const KinematicState start = past.knots[1];
  StopManoeuvre stop;
  const FlightBounds bounds(parameters, nullptr);
  planStop(start, parameters.time.sampling_time, relieveBounds(bounds, start, kBoundSlack), stop);
  CommittedMotion observed;
  observed.assignStop(flight.stamp(), past);
  CommittedMotion braking;
  braking.assignStop(epoch, stop);
  motions.begin(observed, braking);
}

void takeOver(const UavMemory& left, UavRecord& record) {
  if (left.motions == 0) return;
  record.motions.restore(left.newest, left.motions > 1 ? &left.older : nullptr);
  record.planned = true;
  record.beginning.is_left = true;
  record.beginning.on_reference = left.on_reference;
  record.beginning.progress = left.progress;
  record.beginning.target = left.target;
  record.beginning.epoch = left.epoch;
}

void begin(const UavMeasurement& measurement, double epoch, const Parameters& parameters, const FlightBounds& bounds,
           const ObservedFlight* observed, UavRecord& record) {
  Beginning& beginning = record.beginning;
  beginning.pending = false;
  if (beginning.is_left) record.motions.keepNearest(measurement.stamp, measurement.p);
  if (beginning.is_left && !isFlown(measurement, record.motions)) {
    beginning.is_left = false;
    record.motions.clear();
    record.planned = false;
  }
  if (!beginning.is_left && observed != nullptr) {
    assumeBraking(*observed, epoch, parameters, record.motions);
    record.planned = true;
  }
  record.following.settleUntil(epoch + kSettlingTimes * parameters.input.tracking_time);
  record.predictStart(measurement, epoch, parameters, bounds);
  resumeMission(epoch, parameters, observed != nullptr, record);
}

void Takeover::reset(std::optional<std::size_t> obstacles, double epoch) {
  last_epoch_ = epoch;
  for (ObservedFlight& flight : flights_) flight.clear();
  obstacles_ = obstacles;
  begin_.reset();
  finds_flight_ = false;
}

void Takeover::beginCycle(double now) {
  now_ = now;
  if (!begin_) begin_ = now;
}

void Takeover::observe(std::size_t uav, const UavMeasurement& measurement) {
  flights_[uav].add(measurement);
  const bool away = (measurement.p - homes_[uav]).norm() > kAtHome;
  if (measurement.v.norm() > kHovering || away) finds_flight_ = true;
}

bool Takeover::isReady(std::size_t tracks) const {
  const bool knows_all = obstacles_ && tracks >= *obstacles_ && now_ > last_epoch_ + kDistinct;
  return knows_all || (begin_ && now_ - *begin_ >= kPatience) || (!obstacles_ && foreseesEncounter());
}

bool Takeover::foreseesEncounter() const {
  const Vector3 semi_axes(limits_.pair_distance, limits_.pair_distance, limits_.pair_distance_vertical);
  std::vector<Box> swept(flights_.size());
  for (std::size_t i = 0; i < flights_.size(); ++i) {
    if (flights_[i].count() == 0) continue;
    const KinematicState x = predictFromMeasurement(flights_[i].newest(), now_);
    swept[i].include(x.p);
    swept[i].include(x.p + kUrgent * x.v);
    swept[i].min -= 0.5 * semi_axes;
    swept[i].max += 0.5 * semi_axes;
  }
  NeighbourLists near;
  near.build(swept);
  for (std::size_t i = 0; i < flights_.size(); ++i) {
    for (const std::uint32_t j : near.of(i)) {
      const KinematicState a = predictFromMeasurement(flights_[i].newest(), now_);
      const KinematicState b = predictFromMeasurement(flights_[j].newest(), now_);
      if (std::min(a.v.norm(), b.v.norm()) > kHovering) continue;
      const Vector3 apart = (b.p - a.p).cwiseQuotient(semi_axes);
      const Vector3 drift = (b.v - a.v).cwiseQuotient(semi_axes);
      const double speed_squared = drift.squaredNorm();
      const double nearest = speed_squared > 0.0 ? std::clamp(-apart.dot(drift) / speed_squared, 0.0, kUrgent) : 0.0;
      if ((apart + nearest * drift).norm() < 1.0) return true;
    }
  }
  return false;
}

}  // namespace swarm_planner
