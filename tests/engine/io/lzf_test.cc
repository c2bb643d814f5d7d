#include "engine/io/lzf.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace patchlab {
namespace {

std::optional<std::string> decompress(const std::string& compressed, std::size_t size) {
  std::vector<char> out(size);
  if (!lzf_decompress(compressed, out)) return std::nullopt;
  return std::string(out.begin(), out.end());
}

const std::string abc("\2abc", 4);  // a run of three literal bytes

TEST(Lzf, LiteralsAreCopied) { EXPECT_EQ(decompress(abc, 3), "abc"); }

TEST(Lzf, MatchesRepeatWhatWasWritten) {
  EXPECT_EQ(decompress(abc + std::string("\x20\2", 2), 6), "abcabc");    // 3 bytes from 3 back
  EXPECT_EQ(decompress(abc + std::string("\x60\0", 2), 8), "abcccccc");  // 5 bytes from 1 back, overlapping
  EXPECT_EQ(decompress(abc + std::string("\xE0\1\2", 3), 13), "abcabcabcabca");  // 7 + 1 + 2 bytes
}

TEST(Lzf, LongDistancesTakeTheBitsOfBothBytes) {
  std::string compressed, expected;
  for (int run = 0; run < 10; ++run) {
    compressed += std::string("\x1F", 1) + std::string(32, static_cast<char>('a' + run));
    expected += std::string(32, static_cast<char>('a' + run));
  }
  EXPECT_EQ(decompress(compressed + std::string("\x21\x3F", 2), 323), expected + "aaa");  // 320 back
}

TEST(Lzf, DamageIsNoticed) {
  EXPECT_EQ(decompress(abc, 4), std::nullopt) << "too few bytes";
  EXPECT_EQ(decompress(abc, 2), std::nullopt) << "too many bytes";
  EXPECT_EQ(decompress("\2ab", 3), std::nullopt) << "literals cut off";
  EXPECT_EQ(decompress(abc + "\x20", 6), std::nullopt) << "distance cut off";
  EXPECT_EQ(decompress(abc + "\xE0", 12), std::nullopt) << "length cut off";
  EXPECT_EQ(decompress(abc + std::string("\x20\3", 2), 6), std::nullopt) << "before the start";
  EXPECT_EQ(decompress(abc + std::string("\x20\2", 2), 5), std::nullopt) << "a match too long";
}

}  // namespace
}  // namespace patchlab
