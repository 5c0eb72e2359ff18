// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/motion_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace swarm_planner {
namespace {

constexpr std::uint64_t kFormat = 0x31746867696c6673;  // "sflight1": changes with the layout
constexpr std::size_t kMostPoints = 3 * CommittedMotion::kMaxPieces + 1;
// A process that is on its way out may hold the file for so long.
constexpr auto kLockPatience = std::chrono::seconds(2);

std::runtime_error failure(const std::string& what, const std::string& path) {
  return std::runtime_error("cannot " + what + " " + path + ": " + std::strerror(errno));
}

}  // namespace

struct MotionFile::Header {
  std::uint64_t format;
  std::uint64_t uavs;
  FlightIdentity identity;
  std::uint64_t started;
  std::uint64_t obstacles;
  double time_zero, now, written;  ///< [s]
};

struct MotionFile::Slot {
  std::uint64_t sum;  ///< of the rest, as far as it is in use
  std::int64_t pieces;
  double epoch, dt;
  double planned_epoch, progress, target;
  std::array<double, 3 * kMostPoints> points;

  std::size_t pointCount() const { return 3 * static_cast<std::size_t>(pieces) + 1; }

  /// FNV-1a over whole words.
  std::uint64_t expectedSum() const {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&hash](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3; };
    const auto add_number = [&add](double number) {
      std::uint64_t word = 0;
      std::memcpy(&word, &number, sizeof word);
      add(word);
    };
    add(static_cast<std::uint64_t>(pieces));
    for (const double number : {epoch, dt, planned_epoch, progress, target}) add_number(number);
    for (std::size_t i = 0; i < 3 * pointCount(); ++i) add_number(points[i]);
    return hash;
  }

  bool isSound() const {
    return pieces >= 0 && pieces <= CommittedMotion::kMaxPieces && sum == expectedSum() &&
           std::isfinite(planned_epoch) && std::isfinite(progress) && std::isfinite(target);
  }

  void write(const CommittedMotion& motion) {
    pieces = motion.pieces();
    epoch = motion.epoch();
    dt = motion.dt();
    std::size_t at = 0;
    const auto append = [this, &at](const Vector3& point) {
      for (int axis = 0; axis < 3; ++axis) points[at++] = point[axis];
    };
    append(motion.start());
    for (int k = 0; k < motion.pieces(); ++k) {
      const BernsteinPoints<4> piece = motion.piece(k);
      for (std::size_t i = 1; i < 4; ++i) append(piece[i]);
    }
  }

  void read(CommittedMotion& motion) const {
    std::array<Vector3, kMostPoints> from;
    for (std::size_t i = 0; i < pointCount(); ++i) {
      from[i] = Vector3(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    }
    motion.assignPoints(epoch, dt, static_cast<int>(pieces), from.data());
  }
};

struct MotionFile::Entry {
  std::uint64_t count;   ///< motions written so far
  std::uint64_t newest;  ///< which slot
  std::uint64_t has_new_reference;
  std::array<Slot, 2> slots;
};

struct MotionFile::Layout {
  Header header;
  Entry entries[1];  ///< one per UAV
};

MotionFile::MotionFile(const std::string& path, std::size_t uavs)
    : uavs_(uavs), size_(sizeof(Layout) + uavs * sizeof(Entry)) {
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file_ < 0) throw failure("open", path);
  const auto give_up = std::chrono::steady_clock::now() + kLockPatience;
  while (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    if (std::chrono::steady_clock::now() < give_up) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      continue;
    }
    ::close(file_);
    throw std::runtime_error("another planner keeps its record in " + path);
  }
  // Set to its size before it is mapped: beyond the end of a file there is no memory. A file of another size is of
  // another swarm, and what it holds is not read.
  struct stat status = {};
  const bool sized = ::fstat(file_, &status) == 0 && static_cast<std::size_t>(status.st_size) == size_;
  // Blocks are taken now: a full disk must not be found out about in flight.
  const bool ready =
      (sized || ::ftruncate(file_, 0) == 0) && ::posix_fallocate(file_, 0, static_cast<off_t>(size_)) == 0;
  memory_ = ready ? ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0) : MAP_FAILED;
  if (memory_ == MAP_FAILED) {
    const std::runtime_error error = failure("map", path);
    ::close(file_);
    throw error;
  }
}

MotionFile::~MotionFile() {
  ::munmap(memory_, size_);
  ::close(file_);
}

MotionFile::Header& MotionFile::header() const { return static_cast<Layout*>(memory_)->header; }

MotionFile::Entry& MotionFile::entry(std::size_t uav) const { return static_cast<Layout*>(memory_)->entries[uav]; }

std::optional<MotionFile::Content> MotionFile::read() const {
  const Header& from = header();
  if (from.format != kFormat || from.uavs != uavs_ || from.started == 0) return {};
  Content content;
  content.identity = from.identity;
  content.now = from.now;
  content.written = from.written;
  content.memory.time_zero = from.time_zero;
  content.memory.obstacles = from.obstacles;
  content.memory.uavs.resize(uavs_);
  for (std::size_t i = 0; i < uavs_; ++i) {
    UavMemory& uav = content.memory.uavs[i];
    uav.on_reference = entry(i).has_new_reference == 0;
    for (std::uint64_t back = 0; back < 2 && back < entry(i).count; ++back) {
      const Slot& slot = entry(i).slots[(entry(i).newest + back) % 2];
      CommittedMotion& motion = uav.motions == 0 ? uav.newest : uav.older;
      if (!slot.isSound()) continue;
      slot.read(motion);
      if (!motion.isFinite()) continue;
      if (uav.motions == 0) {
        uav.progress = slot.progress;
        uav.target = slot.target;
        uav.epoch = slot.planned_epoch;
      }
      ++uav.motions;
    }
  }
  return content;
}

void MotionFile::clear() {
  header().started = 0;
  header().format = kFormat;
  header().uavs = uavs_;
  for (std::size_t i = 0; i < uavs_; ++i) entry(i).count = entry(i).has_new_reference = 0;
}

void MotionFile::noteNewReference(std::size_t uav) { entry(uav).has_new_reference = 1; }

void MotionFile::write(const SwarmPlanner& planner, const FlightIdentity& identity, std::size_t obstacles, double now,
                       double wall) {
  const CycleReport& report = planner.report();
  for (std::size_t i = 0; i < uavs_; ++i) {
    if (!report.uavs[i].planned) continue;
    Entry& to = entry(i);
    const std::uint64_t spare = to.count == 0 ? 0 : (to.newest + 1) % 2;
    Slot& slot = to.slots[spare];
    slot.write(planner.committed(i));
    slot.planned_epoch = report.epoch;
    slot.progress = planner.progress(i);
    slot.target = planner.target(i, report.epoch).arc_length;
    slot.sum = slot.expectedSum();
    // The process may end anywhere: what is said to be newest has been written.
    std::atomic_signal_fence(std::memory_order_release);
    to.has_new_reference = 0;
    to.newest = spare;
    to.count = std::min<std::uint64_t>(to.count + 1, 2);
  }
  header().identity = identity;
  header().obstacles = obstacles;
  header().time_zero = report.time_zero;
  header().now = now;
  header().written = wall;
  header().started = report.started ? 1 : 0;
}

}  // namespace swarm_planner
