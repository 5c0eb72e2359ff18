// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/csv_recorder.hpp"

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace swarm_planner {
namespace {

constexpr double kSecondsToMilliseconds = 1000.0;

}  // namespace

CsvRecorder::CsvRecorder(const std::string& directory) : directory_(directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw std::runtime_error(directory + ": cannot be created: " + error.message());
  states_ = open("states.csv", "run,time_s,uav,x,y,z,vx,vy,vz,roll,pitch,thrust_n");
  obstacles_ = open("obstacles.csv", "run,time_s,id,x,y,z");
  cycles_ = open("cycles.csv", "run,cycle,time_s,cycle_ms,planned,fallbacks,sqp_iterations,qp_iterations");
  solves_ = open("solves.csv", "run,cycle,uav,solve_ms,sqp_iterations,qp_iterations,max_slack,state");
}

CsvRecorder::File CsvRecorder::open(const std::string& name, const char* header) const {
  const std::string path = directory_ + "/" + name;
  File file(std::fopen(path.c_str(), "w"));
  if (!file) throw std::runtime_error(path + ": cannot be written");
  std::fprintf(file.get(), "%s\n", header);
  return file;
}

void CsvRecorder::beginRun(std::size_t index, const Scenario& scenario) {
  run_ = index;
  uav_names_.clear();
  for (const ScenarioUav& uav : scenario.uavs) uav_names_.push_back(uav.name);
}

void CsvRecorder::finish() {
  for (const File* file : {&states_, &obstacles_, &cycles_, &solves_}) {
    if (std::fflush(file->get()) != 0 || std::ferror(file->get()) != 0) {
      throw std::runtime_error(directory_ + ": not everything could be written");
    }
  }
}

void CsvRecorder::onSample(double t, const std::vector<QuadSimulator>& vehicles,
                           const std::vector<Superellipsoid>& obstacles) {
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    const QuadState& x = vehicles[i].state();
    std::fprintf(states_.get(), "%zu,%.6g,%s,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", run_, t,
                 uav_names_[i].c_str(), x.p.x(), x.p.y(), x.p.z(), x.v.x(), x.v.y(), x.v.z(), x.phi, x.theta,
                 vehicles[i].thrust());
  }
  for (const Superellipsoid& obstacle : obstacles) {
    const Vector3& p = obstacle.center();
    std::fprintf(obstacles_.get(), "%zu,%.6g,%d,%.6f,%.6f,%.6f\n", run_, t, obstacle.id(), p.x(), p.y(), p.z());
  }
}

void CsvRecorder::onCycle(double epoch, const CycleReport& report) {
  std::size_t planned = 0, fallbacks = 0;
  long long sqp_iterations = 0, qp_iterations = 0;
  for (std::size_t i = 0; i < report.uavs.size(); ++i) {
    const UavReport& uav = report.uavs[i];
    planned += uav.planned ? 1 : 0;
    fallbacks += uav.state == UavState::kFallback ? 1 : 0;
    sqp_iterations += uav.sqp_iterations;
    qp_iterations += uav.qp_iterations;
    std::fprintf(solves_.get(), "%zu,%llu,%s,%.6f,%d,%d,%.6g,%s\n", run_, static_cast<unsigned long long>(report.cycle),
                 uav_names_[i].c_str(), kSecondsToMilliseconds * uav.solve_time, uav.sqp_iterations, uav.qp_iterations,
                 uav.max_slack, stateText(uav.state));
  }
  std::fprintf(cycles_.get(), "%zu,%llu,%.6g,%.6f,%zu,%zu,%lld,%lld\n", run_,
               static_cast<unsigned long long>(report.cycle), epoch, kSecondsToMilliseconds * report.cycle_time,
               planned, fallbacks, sqp_iterations, qp_iterations);
}

}  // namespace swarm_planner
