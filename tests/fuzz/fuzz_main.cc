// libFuzzer's entry: fuzz --target=read_pcd build/fuzz/seeds/read_pcd [libFuzzer's own flags].
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz_targets.h"

namespace {

const patchlab::test::FuzzTarget* fuzzed_target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view flag = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view argument = (*argv)[i];
    if (argument.starts_with(flag))
      fuzzed_target = patchlab::test::find_fuzz_target(argument.substr(flag.size()));
  }
  if (fuzzed_target != nullptr) return 0;
  std::fputs("usage: fuzz --target=NAME SEEDS, NAME one of\n", stderr);
  for (const auto& target : patchlab::test::fuzz_targets())
    std::fprintf(stderr, "  %s\n", target.name.data());
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto outcome = fuzzed_target->feed({reinterpret_cast<const char*>(data), size});
  if (outcome.complaint.empty()) return 0;
  std::fprintf(stderr, "%s\n", outcome.complaint.c_str());
  std::abort();
}
