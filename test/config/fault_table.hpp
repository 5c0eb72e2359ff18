// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <stdexcept>
#include <string>

#include "swarm_planner/config/faults.hpp"

namespace swarm_planner {

/// A file that is right but for one change, and the one fault that a user must be shown for it.
struct FaultCase {
  std::string name;         ///< of the test
  std::string original;     ///< this text of the right file ...
  std::string replacement;  ///< ... becomes this
  std::string key;          ///< exact key of the fault
  std::string message;      ///< part of its message
};

inline std::ostream& operator<<(std::ostream& stream, const FaultCase& fault_case) { return stream << fault_case.name; }

inline std::string caseName(const testing::TestParamInfo<FaultCase>& info) { return info.param.name; }

/// `text` with the first `original` replaced; a case whose original is not there would test nothing.
inline std::string changed(std::string text, const std::string& original, const std::string& replacement) {
  const std::size_t position = text.find(original);
  if (position == std::string::npos) throw std::invalid_argument("not in the file: " + original);
  return text.replace(position, original.size(), replacement);
}

inline void expectOnlyFault(const Faults& faults, const std::string& source, const FaultCase& expected) {
  ASSERT_EQ(faults.list().size(), 1u) << faults.text();
  EXPECT_EQ(faults.list()[0].source, source);
  EXPECT_EQ(faults.list()[0].key, expected.key);
  EXPECT_NE(faults.list()[0].message.find(expected.message), std::string::npos) << faults.list()[0].message;
}

}  // namespace swarm_planner
