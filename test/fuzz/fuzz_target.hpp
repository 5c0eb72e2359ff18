// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "swarm_planner/config/types.hpp"

/// What a target has to define, once per program: one input, any bytes. Whatever it finds wrong ends the program
/// (FUZZ_CHECK, an exception that escapes, a sanitizer). libFuzzer calls it by this name; so does fuzz_driver.cpp.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace swarm_planner {

/// Inputs to begin with, for mutation: valid ones that reach far into the code.
std::vector<std::string> fuzzSeeds();

/// Eleven seeds of any bytes, seed i `shortest` + i `longer` bytes long, always the same for a `stream`.
inline std::vector<std::string> seedsOfBytes(std::size_t shortest, std::size_t longer, unsigned stream) {
  std::vector<std::string> seeds;
  for (unsigned seed = 1; seed < 12; ++seed) {
    std::string bytes(shortest + longer * seed, '\0');
    unsigned state = stream * seed;
    for (char& each : bytes) each = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
    seeds.push_back(bytes);
  }
  return seeds;
}

/// A shipped file, for a seed.
inline std::string textOf(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Ends the program if a promise to the user is broken; in all builds, unlike assert.
#define FUZZ_CHECK(condition)                                                                 \
  do {                                                                                        \
    if (!(condition)) {                                                                       \
      std::fprintf(stderr, "%s:%d: FUZZ_CHECK failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                           \
    }                                                                                         \
  } while (false)

/// Numbers out of the bytes of an input; zeros once they are used up.
class FuzzData {
 public:
  FuzzData(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }

  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }

  /// In [0, end).
  std::size_t below(std::size_t end) {
    std::size_t value = byte();
    if (end > 256) value = 256 * value + byte();
    return value % end;
  }

  /// Uniform in steps within [low, high].
  double within(double low, double high) { return low + (high - low) * (256.0 * byte() + byte()) / 65535.0; }

  /// Mostly within [low, high]; one in eight anything: limits, signs, infinities, NaN, any eight bytes.
  double wild(double low, double high) {
    const std::uint8_t kind = byte();
    if (kind < 224) return within(low, high);
    constexpr double kNumbers[] = {0.0,    -0.0, 1e-300, 1e-9,    1.0, -1.0, 2.0,   999.0, 1e3,
                                   1001.0, 1e6,  9.9e6,  -9.99e6, 1e7, 1e8,  1e150, 1e300, -1e300};
    constexpr std::size_t kCount = sizeof(kNumbers) / sizeof(kNumbers[0]);
    if (kind < 248) return kNumbers[below(kCount)];
    std::uint8_t raw[8];
    for (std::uint8_t& each : raw) each = kind < 252 ? byte() : 0xFF;  // all ones: NaN
    double value = 0.0;
    std::memcpy(&value, raw, sizeof(value));
    return value;
  }

  Vector3 wildVector(double low, double high) {
    const double x = wild(low, high);
    const double y = wild(low, high);
    return Vector3(x, y, wild(low, high));
  }

  std::string rest() { return std::string(reinterpret_cast<const char*>(data_), left_); }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace swarm_planner
