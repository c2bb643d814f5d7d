// Small valid files, damaged at random: every reader refuses them with a sentence or gives what hangs
// together, in bounded memory and bounded time. A crash ends the program, and the sanitizers' report names
// the damaged file.
#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>

#include "engine/base/file.h"
#include "tests/fuzz/allocation_watch.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/fuzz/mutations.h"
#include "tests/support/seeded_random.h"

extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace patchlab::test {

void PrintTo(const FuzzTarget& target, std::ostream* out) { *out << target.name; }

namespace {

constexpr int short_run = 250, long_run = 12'000;           // of each target
constexpr std::size_t bytes_beside = std::size_t{2} << 20;  // what a reader may take whatever the file

std::vector<std::string> seeds_of(const FuzzTarget& target) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(PATCHLAB_FUZZ_SEEDS) / target.name))
    files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<std::string> seeds;
  for (const std::filesystem::path& file : files) {
    const Result<Bytes> bytes = read_file(file);
    if (bytes) seeds.emplace_back(as_text(*bytes));
  }
  return seeds;
}

std::string_view fed;

bool write_to_errors(std::string_view text) { return ::write(STDERR_FILENO, text.data(), text.size()) >= 0; }

void end_of_patience(int) {
  const bool said = write_to_errors("A reader hangs on this file:\n") && write_to_errors(fed);
  ::_exit(said ? 1 : 2);
}

void name_file_of_crash() {
  if (!fed.empty() && write_to_errors("A reader crashed on this file:\n")) write_to_errors(fed);
}

// Ends the program where a reader takes two seconds of the processor, ten thousand times what these files
// take; what else runs does not count.
class ProcessorLimit {
 public:
  explicit ProcessorLimit(std::string_view file) {
    fed = file;
    std::signal(SIGPROF, end_of_patience);
    set_timer(2);
  }
  ProcessorLimit(const ProcessorLimit&) = delete;
  ProcessorLimit& operator=(const ProcessorLimit&) = delete;
  ~ProcessorLimit() { set_timer(0); }

 private:
  static void set_timer(std::time_t seconds) {
    const itimerval timer{{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_PROF, &timer, nullptr);
  }
};

void expect_in_bounds(const Allocations& taken, std::size_t file_bytes) {
  const std::size_t bound = 4 * file_bytes + bytes_beside;
  EXPECT_LE(taken.largest, bound) << "bytes in one allocation, of a file of " << file_bytes;
  EXPECT_LE(taken.peak, bound) << "bytes at once, of a file of " << file_bytes;
}

bool feed(const FuzzTarget& target, const std::string& file) {
  const ProcessorLimit limit(file);
  watch_allocations();
  const Outcome outcome = target.feed(file);
  const Allocations allocations = watched_allocations();
  fed = {};
  EXPECT_EQ(outcome.complaint, "");
  expect_in_bounds(allocations, file.size());
  return outcome.accepted;
}

void run(const FuzzTarget& target, int mutations) {
  SeededRandom random;
  const std::vector<std::string> seeds = seeds_of(target);
  ASSERT_FALSE(seeds.empty());
  int accepted = 0;
  for (int i = 0; i < mutations; ++i) {
    const std::string file = mutated(seeds[static_cast<std::size_t>(i) % seeds.size()], random);
    accepted += feed(target, file) ? 1 : 0;
    if (testing::Test::HasFailure()) FAIL() << "mutation " << i << ": " << testing::PrintToString(file);
  }
  EXPECT_GT(accepted, mutations / 500) << "the damage never gets past the header";
  EXPECT_LT(accepted, mutations - mutations / 500) << "no damage is noticed";
}

class MutationTest : public testing::TestWithParam<FuzzTarget> {
 protected:
  static void SetUpTestSuite() {
    if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(name_file_of_crash);
  }
};

TEST_P(MutationTest, StartsFromFilesThatAreRead) {
  for (const std::string& seed : seeds_of(GetParam()))
    EXPECT_TRUE(feed(GetParam(), seed)) << testing::PrintToString(seed);
}

TEST_P(MutationTest, IsRefusedWithASentenceOrWhole) { run(GetParam(), short_run); }

// The readers of scans, nine of the targets, get more than 100,000 in all.
TEST_P(MutationTest, BatteryIsRefusedWithASentenceOrWhole) { run(GetParam(), long_run); }

INSTANTIATE_TEST_SUITE_P(Targets, MutationTest,
                         testing::ValuesIn(fuzz_targets().begin(), fuzz_targets().end()),
                         [](const auto& target) { return std::string(target.param.name); });

std::string repeated(std::string_view piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

std::string attributes(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += " x" + std::to_string(i) + "='1'";
  return text;
}

TEST(LongFiles, TakeNoMoreThanTheirShareOfTime) {
  const std::pair<const char*, std::string> files[] = {
      {"patch_set", "{\"patches\": [" + repeated("{},", 100'000) + "{}]}"},
      {"joints", "{\"joints\": " + repeated("[", 100'000)},
      {"urdf", "<robot name='r'><link name='a'" + attributes(50'000) + "/></robot>"},
      {"read_point_table", "x,y,z" + repeated(",a", 100'000) + "\n1,2,3" + repeated(",4", 100'000) + "\n"},
      {"read_obj", "v 1 2 3\nf" + repeated(" 1", 300'000) + "\n"},
      {"region", repeated("1\n", 300'000)}};
  for (const auto& [name, file] : files) {
    const ProcessorLimit limit(name);
    EXPECT_EQ(find_fuzz_target(name)->feed(file).complaint, "") << name;
  }
}

TEST(AllocationWatch, CountsWhatIsHeldAtOnce) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the address sanitizer counts, and this build has none";
  watch_allocations();
  for (int i = 0; i < 3; ++i) {
    const std::vector<char> large(3000), small(1000);
    EXPECT_EQ(large.size() + small.size(), 4000U);
  }
  EXPECT_EQ(watched_allocations().largest, 3000U);
  EXPECT_GE(watched_allocations().peak, 4000U);
  EXPECT_LT(watched_allocations().peak, 5000U);
}

TEST(ProcessorLimitBattery, EndsWhatHangs) {
  const auto hang = [] {
    const ProcessorLimit limit("the file");
    const std::atomic<bool> forever = true;
    while (forever) continue;
  };
  EXPECT_EXIT(hang(), testing::ExitedWithCode(1), "hangs on this file:\nthe file");
}

}  // namespace
}  // namespace patchlab::test
