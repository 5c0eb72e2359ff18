// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/flight_record.hpp"

#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "swarm_planner/experiments/atomic_file.hpp"
#include "swarm_planner/ros/node_constants.hpp"

namespace swarm_planner {
namespace {

constexpr int kDigits = 17;

/// FNV-1a.
std::uint64_t fingerprint(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3;
  return hash;
}

std::vector<std::string> namesOf(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const ScenarioUav& uav : scenario.uavs) names.push_back(uav.name);
  return names;
}

std::string withFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  return path;  // what is wrong shows when files are opened there
}

UavOrders::Reference readReference(const YAML::Node& node) {
  UavOrders::Reference reference;
  for (const YAML::Node& point : node["path"]) {
    reference.path.emplace_back(point[0].as<double>(), point[1].as<double>(), point[2].as<double>());
  }
  reference.start = node["start"].as<double>();
  reference.speed = node["speed"].as<double>();
  return reference;
}

void emit(YAML::Emitter& out, const UavOrders::Reference& reference) {
  out << YAML::Key << "reference" << YAML::Value << YAML::BeginMap << YAML::Key << "path" << YAML::Value
      << YAML::BeginSeq;
  for (const Vector3& p : reference.path) {
    out << YAML::Flow << YAML::BeginSeq << p.x() << p.y() << p.z() << YAML::EndSeq;
  }
  out << YAML::EndSeq << YAML::Key << "start" << YAML::Value << reference.start << YAML::Key << "speed" << YAML::Value
      << reference.speed << YAML::EndMap;
}

}  // namespace

FlightRecord::FlightRecord(const std::string& path, const Mission& mission, const std::string& run_id, double wall)
    : orders_path_(withFolder(path) + ".orders.yaml"),
      names_(namesOf(mission.scenario)),
      identity_{fingerprint(toYaml(mission.scenario)), fingerprint(run_id)},
      orders_(names_.size()),
      motions_(path + ".motions", names_.size()),
      left_(motions_.read()) {
  readOrders(wall);
  if (left_ && !isSameFlight(left_->identity, wall)) {
    ignored_ = "the record is of another flight";
    left_.reset();
  }
  // Whatever is kept from now on is of this flight.
  motions_.clear();
  writeOrders();
}

bool FlightRecord::isSameFlight(const FlightIdentity& identity, double wall) const {
  if (identity.scenario != identity_.scenario) return false;
  const bool recent = left_ && std::abs(wall - left_->written) < kMasterRestart;
  return identity.run == identity_.run || recent;
}

void FlightRecord::readOrders(double wall) {
  std::vector<UavOrders> orders(names_.size());
  try {
    const YAML::Node file = YAML::LoadFile(orders_path_);
    const FlightIdentity identity{file["scenario"].as<std::uint64_t>(), file["run"].as<std::uint64_t>()};
    if (!isSameFlight(identity, wall)) return;
    for (const YAML::Node& node : file["uavs"]) {
      const auto found = std::find(names_.begin(), names_.end(), node["name"].as<std::string>());
      if (found == names_.end()) throw std::runtime_error("a UAV that is not in the scenario");
      UavOrders& uav = orders[static_cast<std::size_t>(found - names_.begin())];
      uav.mode = node["mode"].as<int>();
      if (node["reference"]) uav.reference = readReference(node["reference"]);
    }
    orders_ = orders;
  } catch (const YAML::BadFile&) {
    // There is none.
  } catch (const std::exception& error) {
    ignored_ = orders_path_ + " cannot be read: " + error.what();
  }
}

bool FlightRecord::writeOrders() {
  YAML::Emitter out;
  out.SetDoublePrecision(kDigits);
  out << YAML::BeginMap << YAML::Key << "scenario" << YAML::Value << identity_.scenario << YAML::Key << "run"
      << YAML::Value << identity_.run << YAML::Key << "uavs" << YAML::Value << YAML::BeginSeq;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    out << YAML::BeginMap << YAML::Key << "name" << YAML::Value << names_[i] << YAML::Key << "mode" << YAML::Value
        << orders_[i].mode;
    if (orders_[i].reference) emit(out, *orders_[i].reference);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
  try {
    AtomicFile(orders_path_).write(std::string(out.c_str()) + "\n");
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

std::optional<FlightMemory> FlightRecord::takeMotions(double now, double wall) {
  const std::optional<MotionFile::Content> left = std::move(left_);
  left_.reset();
  if (!left) return {};
  if (left->now > now + kFutureTolerance) {
    ignored_ = "ROS time has jumped back since the motions on record";
    return {};
  }
  if (wall - left->written > kLongestWait) {
    ignored_ = "the motions on record are too old";
    return {};
  }
  return left->memory;
}

bool FlightRecord::setModes(const std::vector<int>& modes) {
  bool changed = false;
  for (std::size_t i = 0; i < orders_.size(); ++i) {
    changed = changed || orders_[i].mode != modes[i];
    orders_[i].mode = modes[i];
  }
  return !changed || writeOrders();
}

bool FlightRecord::setReference(std::size_t uav, const UavOrders::Reference& reference) {
  orders_[uav].reference = reference;
  motions_.noteNewReference(uav);
  return writeOrders();
}

void FlightRecord::write(const SwarmPlanner& planner, std::size_t obstacles, double now, double wall) {
  motions_.write(planner, identity_, obstacles, now, wall);
}

void FlightRecord::forgetMotions() { motions_.clear(); }

std::string defaultRecordPath(const std::string& node, const std::string& master_uri) {
  const std::filesystem::path memory = "/dev/shm";
  std::error_code error;
  const std::filesystem::path base =
      std::filesystem::is_directory(memory, error) ? memory : std::filesystem::temp_directory_path(error);
  std::string name = node;
  std::replace(name.begin(), name.end(), '/', '_');
  return base / ("swarm_planner_" + std::to_string(::getuid())) /
         (name.substr(std::min<std::size_t>(1, name.size())) + "_" + std::to_string(fingerprint(master_uri)));
}

}  // namespace swarm_planner
