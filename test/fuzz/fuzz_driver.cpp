// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Feeds a target with mutated inputs for FUZZ_SECONDS (3 by default), or FUZZ_COUNT of them, from FUZZ_SEED (1). Input
// i of a seed is always the same: FUZZ_FIRST=i FUZZ_COUNT=1 repeats it. FUZZ_CORPUS=DIR only writes the seeds there.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <limits>
#include <random>

#include "fuzz_target.hpp"

namespace swarm_planner {
namespace {

constexpr std::size_t kMostBytes = 4096;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
char report[160];  // for the handler of signals, which may not format

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

extern "C" void tellInput(int signal) {
  const ssize_t ignored = write(STDERR_FILENO, report, strlen(report));
  (void)ignored;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// An exception ends the program here, where the handler tells which input it was.
void feed(const std::string& input) noexcept {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

class Mutator {
 public:
  explicit Mutator(std::vector<std::string> seeds) : seeds_(std::move(seeds)) {}

  std::string input(std::uint64_t seed, std::uint64_t index) {
    random_.seed(static_cast<std::mt19937::result_type>(seed * 0x9E3779B97F4A7C15ULL + index));
    std::string input = seeds_[below(seeds_.size())];
    if (below(16) == 0) {
      input.assign(below(600), '\0');
      for (char& each : input) each = static_cast<char>(random_());
    }
    for (std::size_t changes = below(9); changes > 0; --changes) change(input);
    if (input.size() > kMostBytes) input.resize(kMostBytes);
    return input;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void change(std::string& input) {
    const std::size_t at = below(input.size() + 1);
    const std::size_t length = 1 + below(below(4) == 0 ? 64 : 8);
    switch (below(8)) {
      case 0:
        if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
        break;
      case 1:
        if (at < input.size()) input[at] = static_cast<char>(random_());
        break;
      case 2:
        input.erase(at, length);
        break;
      case 3:
        input.insert(at, length, static_cast<char>(random_()));
        break;
      case 4:
        overwrite(input, at);
        break;
      case 5:  // a piece of this input somewhere else
        input.insert(at, input.substr(below(input.size() + 1), length));
        break;
      case 6: {  // a piece of another one
        const std::string& other = seeds_[below(seeds_.size())];
        input.insert(at, other.substr(below(other.size() + 1), length));
        break;
      }
      default:
        input.insert(at, words_[below(words_.size())]);
    }
  }

  // Numbers of messages at their places: doubles and lengths.
  void overwrite(std::string& input, std::size_t at) {
    constexpr double kDoubles[] = {0.0, -1.0, 1.0, 1e300, -1e300, 1e8, 1e7, 1e-300, kInfinity, -kInfinity, kNan};
    constexpr std::uint32_t kLengths[] = {0, 1, 255, 65536, 1000000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
    const double number = kDoubles[below(sizeof(kDoubles) / sizeof(double))];
    const std::uint32_t length = kLengths[below(sizeof(kLengths) / sizeof(std::uint32_t))];
    const bool is_length = below(2) == 0;
    const std::size_t size = is_length ? sizeof(length) : sizeof(number);
    if (at + size <= input.size())
      std::memcpy(&input[at], is_length ? static_cast<const void*>(&length) : &number, size);
  }

  const std::vector<std::string> seeds_;
  const std::vector<std::string> words_{
      "1e300", ".nan", "-.inf", "1e8", "-1", "0",      "[[[[", "{",    "}",  "]",  ": ",  "- ",   "&a ",
      "*a",    "!!",   "\n",    "\t",  "#",  "name: ", "uavs", "\xFF", "\"", "| ", "---", "true", "99999999999999"};
  std::mt19937 random_;
};

void writeCorpus(const std::string& directory) {
  const std::vector<std::string> seeds = fuzzSeeds();
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    std::ofstream(directory + "/seed_" + std::to_string(i), std::ios::binary) << seeds[i];
  }
}

TEST(Fuzz, NoInputBreaksAPromise) {
  if (const char* directory = std::getenv("FUZZ_CORPUS")) return writeCorpus(directory);
  const std::uint64_t seed = setting("FUZZ_SEED", 1);
  const std::uint64_t first = setting("FUZZ_FIRST", 0);
  const std::uint64_t count = setting("FUZZ_COUNT", 0);
  const std::chrono::seconds most_time(count > 0 ? 86400 : setting("FUZZ_SECONDS", 3));
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS}) std::signal(signal, tellInput);
  Mutator mutator(fuzzSeeds());
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t done = 0;
  for (; count == 0 || done < count; ++done) {
    if (std::chrono::steady_clock::now() - start > most_time) break;
    const std::string input = mutator.input(seed, first + done);
    std::snprintf(report, sizeof(report), "fuzzing failed; repeat with FUZZ_SEED=%llu FUZZ_FIRST=%llu FUZZ_COUNT=1\n",
                  static_cast<unsigned long long>(seed), static_cast<unsigned long long>(first + done));
    feed(input);
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::printf("%llu inputs in %.1f s\n", static_cast<unsigned long long>(done), time.count());
  EXPECT_GT(done, 0U);
}

}  // namespace
}  // namespace swarm_planner
