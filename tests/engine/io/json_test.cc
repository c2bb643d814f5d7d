#include "engine/io/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "engine/base/random.h"

namespace patchlab {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using testing::HasSubstr;

std::string refusal(const std::string& text) {
  const Result<json> value = parse_json(text, "a.json");
  return value ? "accepted" : value.error().message;
}

TEST(ParseJson, SaysWhereATextIsNoJson) {
  EXPECT_THAT(refusal("{\n  \"a\": 1,\n}"),
              HasSubstr("a.json: is not JSON: parse error at line 3, column 1"));
  for (const char* text : {"", "nul", "[1, 2", "{} {}", "[NaN]", "[1e999]", "[01]", "\"\xff\"", "[1] x"}) {
    EXPECT_THAT(refusal(text), HasSubstr("a.json: is not JSON")) << text;
  }
}

TEST(ParseJson, RefusesAMemberThatStandsTwice) {
  EXPECT_THAT(refusal(R"({"a": {"b": 1, "b": 2}})"), HasSubstr("the member \"b\" twice"));
  EXPECT_EQ(refusal(R"({"a": {"b": 1}, "b": [{"b": 1}, {"b": 2}]})"), "accepted");
}

TEST(ParseJson, RefusesNestingThatWouldExhaustTheStack) {
  EXPECT_EQ(refusal(std::string(60, '[') + std::string(60, ']')), "accepted");
  EXPECT_THAT(refusal(std::string(100, '[') + std::string(100, ']')), HasSubstr("nested deeper than 64"));
  EXPECT_THAT(refusal(std::string(300000, '[') + std::string(300000, ']')),
              HasSubstr("nested deeper than 64"));
}

TEST(JsonText, ReadsBackAnyFiniteDoubleToTheSameBits) {
  Random random(17);
  ordered_json numbers = ordered_json::array();
  for (int i = 0; i < 20000; ++i) {
    const auto bits = static_cast<std::uint64_t>(random.index(std::numeric_limits<std::size_t>::max()));
    if (const auto number = std::bit_cast<double>(bits); std::isfinite(number)) numbers.push_back(number);
  }
  const json read = *parse_json(*json_text(numbers, "numbers"), "numbers");
  ASSERT_EQ(read.size(), numbers.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i].get<double>()),
              std::bit_cast<std::uint64_t>(numbers[i].get<double>()));
  }
}

TEST(JsonText, KeepsShortThingsOnALineAndBreaksLongOnes) {
  const std::string x(60, 'x');
  const ordered_json value = {{"short", {1.5, 2.0}}, {"long", {x, x, x}}};
  EXPECT_EQ(*json_text(value, ""), "{\n  \"short\": [1.5, 2.0],\n  \"long\": [\n    \"" + x + "\",\n    \"" +
                                       x + "\",\n    \"" + x + "\"\n  ]\n}\n");
}

TEST(JsonText, RefusesWhatIsNotFiniteByItsPlace) {
  const ordered_json value = {{"a", {{"b", {0.0, std::nan("")}}}}};
  const Result<std::string> text = json_text(value, "a.json");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::refused);
  EXPECT_EQ(text.error().message, "a.json: a.b[1] is not a number; nothing was written.");
}

TEST(JsonPlace, KeepsTheFirstFaultAndGivesDefaultsFromThenOn) {
  const json value = {{"camera", {{"fx", "wide"}}}};
  std::optional<Error> error;
  const JsonPlace root(value, "a.json", error);
  EXPECT_EQ(root["camera"]["fx"].number(), 0.0);
  EXPECT_EQ(root["camera"]["fy"].number(), 0.0);
  EXPECT_TRUE(root["objects"].items().empty());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->message, "a.json: camera.fx is \"wide\" where a number is expected.");
}

TEST(JsonPlace, ShowsWhatItFoundWhereThatIsShort) {
  const auto message = [](const json& value) {
    std::optional<Error> error;
    EXPECT_EQ(JsonPlace(value, "a.json", error).number(), 0.0);
    return error->message;
  };
  EXPECT_EQ(message(true), "a.json: the file is true where a number is expected.");
  EXPECT_EQ(message(json::array({1, 2})), "a.json: the file is an array where a number is expected.");
  EXPECT_EQ(message(std::string(50, 'x')), "a.json: the file is a long string where a number is expected.");
}

TEST(JsonPlace, TakesOnlyWholeNumbersAsCounts) {
  for (const json& value : {json(-1), json(1.5), json(11u), json("1"), json(nullptr)}) {
    std::optional<Error> error;
    EXPECT_EQ(JsonPlace(value, "a.json", error).whole_number(10), 0u);
    EXPECT_TRUE(error) << value;
  }
  const json ten = 10u;
  std::optional<Error> error;
  EXPECT_EQ(JsonPlace(ten, "a.json", error).whole_number(10), 10u);
  EXPECT_FALSE(error);
}

}  // namespace
}  // namespace patchlab
