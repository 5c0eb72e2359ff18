// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/problem/joint_problem.hpp"

#include <algorithm>
#include <numeric>

namespace swarm_planner {

MovingBody UavPair::bodyOfSecond(const KinematicState& first_start, const PredictedMotion& second_motion) const {
  MovingBody body = MovingBody::fromUav(second_motion, horizontal, vertical, Vector3::UnitX());
  body.relieve(first_start.p - second_motion.point(0, 0), margin);
  return body;
}

void predict(const Trajectory& plan, PredictedMotion& predicted) {
  predicted.box = Box();
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const SegmentPoints points = segmentPoints(plan.knots[k], plan.knots[k + 1], plan.dt);
    for (std::size_t i = 0; i < points.size(); ++i) predicted.points[3 * k + i] = points[i];
  }
  for (const Vector3& point : predicted.points) predicted.box.include(point);
}

double JointMerit::value() const {
  return std::accumulate(of_pairs.begin(), of_pairs.end(), std::accumulate(of_uavs.begin(), of_uavs.end(), 0.0));
}

void findJointMerit(const JointProblem& problem, const std::vector<Trajectory>& plans,
                    const std::vector<PredictedMotion>& motions, const JointPlanes& planes, JointMerit& merit) {
  merit.of_uavs.resize(problem.uavs.size());
  merit.of_pairs.assign(problem.pairs.size(), 0.0);
  merit.largest_violation.resize(problem.uavs.size());
  for (std::size_t i = 0; i < problem.uavs.size(); ++i) {
    const Merit own = swarm_planner::merit(*problem.uavs[i], plans[i], planes.of_uavs[i]);
    merit.of_uavs[i] = own.value;
    merit.largest_violation[i] = own.largest_violation;
  }
  auto plane = planes.of_pairs.begin();
  PlanPoints points;
  std::size_t points_of = problem.uavs.size();
  for (std::size_t index = 0; index < problem.pairs.size(); ++index) {
    const UavPair& pair = problem.pairs[index];
    const UavProblem& first = *problem.uavs[pair.first];
    while (plane != planes.of_pairs.end() && plane->body < index) ++plane;
    const MovingBody body = pair.bodyOfSecond(first.start, motions[pair.second]);
    if (!body.box().near(motions[pair.first].box, 0.0)) continue;
    if (points_of != pair.first) findConstrainedPoints(first, plans[pair.first], points);
    points_of = pair.first;
    Violation violation;
    addBodyViolations(first, body, index, points, plane, planes.of_pairs.end(), violation);
    merit.of_pairs[index] = penaltyOf(violation, first.parameters->sqp);
    for (const std::size_t i : {pair.first, pair.second}) {
      merit.largest_violation[i] = std::max(merit.largest_violation[i], violation.largest);
    }
  }
}

}  // namespace swarm_planner
