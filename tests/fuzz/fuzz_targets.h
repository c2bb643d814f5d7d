// What any bytes are fed to: each reader of files that users or other programs left. libFuzzer (fuzz_main.cc)
// and the seeded battery (mutation_battery_test.cc) run the same targets.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace patchlab::test {

struct Outcome {
  bool accepted = false;
  std::string complaint;  // what is wrong with the answer, be it a value or a refusal; empty: nothing
};

struct FuzzTarget {
  std::string_view name;  // of its folder of seeds too
  Outcome (*feed)(std::string_view bytes);
};

std::span<const FuzzTarget> fuzz_targets();
const FuzzTarget* find_fuzz_target(std::string_view name);  // nullptr where there is none

}  // namespace patchlab::test
