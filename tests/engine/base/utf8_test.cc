#include "engine/base/utf8.h"

#include <gtest/gtest.h>

namespace patchlab {
namespace {

constexpr std::size_t fine = std::string_view::npos;

TEST(Utf8, TextOfAnyLengthOfCharactersIsFine) {
  EXPECT_EQ(first_not_utf8(""), fine);
  EXPECT_EQ(first_not_utf8("robot"), fine);
  EXPECT_EQ(first_not_utf8("Gr\u00f6\u00dfe \u03c3 \u20ac \U0001f916"), fine);
}

TEST(Utf8, TheFirstByteThatIsNoTextIsFound) {
  EXPECT_EQ(first_not_utf8("Gr\xf6\xdf"), 2u) << "Latin-1";
  EXPECT_EQ(first_not_utf8("a\x80"), 1u) << "no lead";
  EXPECT_EQ(first_not_utf8("ab\xe2\x82"), 2u) << "cut off";
  EXPECT_EQ(first_not_utf8("\xc0\x80"), 0u) << "longer than need be";
  EXPECT_EQ(first_not_utf8("\xed\xa0\x80"), 0u) << "half of a pair of UTF-16";
  EXPECT_EQ(first_not_utf8("\xf4\x90\x80\x80"), 0u) << "beyond the last character";
  EXPECT_EQ(first_not_utf8("\xff"), 0u);
}

}  // namespace
}  // namespace patchlab
