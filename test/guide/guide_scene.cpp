// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "guide_scene.hpp"

#include <algorithm>

namespace swarm_planner {
namespace {

GuideSettings testSettings() {
  GuideSettings settings;
  settings.horizontal = settings.vertical = 2.2;
  settings.least_gap = 1.5;
  settings.comfort = 0.18;
  settings.slack = 0.03;
  return settings;
}

}  // namespace

GuideBody bodyOf(const Vector3& center, const Vector3& radii, double exponent, const Vector3& velocity) {
  GuideBody body;
  body.shape = Superellipsoid(1, center, radii, Vector3::Constant(exponent), 0.0, velocity);
  body.distance = kTestDistance;
  return body;
}

Workspace roomOf(const Vector3& min, const Vector3& max) {
  Workspace room;
  room.min = min;
  room.max = max;
  return room;
}

SearchScene::SearchScene(const Workspace& room) : space_(100), traffic_(2.2, 2.2, 10) {
  space_.clear(room);
  traffic_.clear(0.6);
}

void SearchScene::add(const GuideBody& body) {
  bodies_.push_back(body);
  space_.add(bodies_.back());
}

SearchOutcome SearchScene::search(const Vector3& start, const Vector3& goal, double cell, int budget) {
  SearchQuery query;
  query.start = start;
  query.goal = goal;
  query.pace = {0.0, kSpeed};
  query.cell = cell;
  query.budget = budget;
  query.region.min = Vector3::Constant(-1e3);
  query.region.max = Vector3::Constant(1e3);
  const SearchOutcome outcome = lattice_.search(query, space_, traffic_, path_);
  if (outcome == SearchOutcome::kFound) tighten(path_, query.pace, space_, traffic_);
  return outcome;
}

double SearchScene::leastClearance() const {
  constexpr double kStep = 0.01;
  const Pace pace{0.0, kSpeed};
  double way = 0.0;
  double least = BodySpace::kFar;
  for (std::size_t i = 0; i + 1 < path_.count; ++i) {
    const Vector3 piece = path_.points[i + 1] - path_.points[i];
    for (double s = 0.0; s <= piece.norm(); s += kStep) {
      least = std::min(least, space_.clearance(pace.after(path_.points[i] + s * piece.normalized(), way + s)));
    }
    way += piece.norm();
  }
  return least;
}

GuideRounds::GuideRounds(std::size_t uavs)
    : settings(testSettings()), requests(uavs), answers(uavs), planner(settings, uavs, 100) {
  scene.bodies.reserve(100);
  scene.flights.resize(uavs);
  scene.spacing = 0.6;
}

void GuideRounds::follow(std::size_t uav, const Vector3& start, const Vector3& end, const Vector3& position) {
  GuideRequest& request = requests[uav];
  const ReferencePath reference({start, end});
  request.wanted = true;
  request.version = 1;
  request.start = position;
  request.speed = 3.0;
  request.path.assign(reference, reference.nearest(position, 0.0, 1e3).arc_length);
  request.reach = 30.0;
  request.workspace = roomOf(Vector3(-50, -50, 0), Vector3(150, 50, 30));
}

const GuideAnswer& GuideRounds::round() {
  planner.plan(scene, requests, answers);
  return answers.front();
}

}  // namespace swarm_planner
