// Random numbers of a test: the seed follows from the test's name, and is shown where an assertion fails.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/random.h"

namespace patchlab::test {

inline std::string current_test_name() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  return std::string(test->test_suite_name()) + "." + test->name();
}

// FNV-1a: the same on every machine.
inline std::uint64_t seed_of(std::string_view name) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

// Precondition: constructed in the body of a test.
class SeededRandom : public Random {
 public:
  SeededRandom() : Random(seed_of(current_test_name())), trace_(__FILE__, __LINE__, message()) {}

 private:
  static std::string message() {
    return "random numbers of seed " + std::to_string(seed_of(current_test_name())) +
           ", from the test's name";
  }
  testing::ScopedTrace trace_;
};

}  // namespace patchlab::test
