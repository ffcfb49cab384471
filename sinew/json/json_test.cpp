// Values keep their contents when they are written and read again; texts that are not JSON are
// refused.
#include "sinew/json/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <sstream>

namespace sinew::json_test {
namespace {

// Value with all types that a text keeps, including ones that are difficult to write.
Json random_value(std::mt19937& random, int deepest) {
  const auto kind = random() % (deepest > 0 ? 8 : 6);
  if (kind == 0) return nullptr;
  if (kind == 1) return random() % 2 == 0;
  if (kind == 2) return -static_cast<std::int64_t>(random());
  if (kind == 3) return (std::uint64_t{random()} << 32) | random();
  if (kind == 4)
    return std::ldexp(static_cast<double>(random()) + 0.5, static_cast<int>(random() % 400) - 200);
  if (kind == 5) return std::string("\"\\\n\x01<\u00b5", 5 + 2 * (random() % 2));
  Json out = kind == 6 ? Json::array() : Json::object();
  for (auto n = random() % 5; n > 0; --n) {
    Json value = random_value(random, deepest - 1);
    if (kind == 6)
      out.push_back(std::move(value));
    else
      out["key " + std::to_string(n)] = std::move(value);
  }
  return out;
}

TEST(Json, ReadsWhatItWrites) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const Json value = random_value(random, 4);
    const std::string text = value.text();
    Json again;
    ASSERT_TRUE(Json::parse(text, again)) << text;
    EXPECT_EQ(again, value) << text;
    EXPECT_EQ(Json::parse(value.text(2)).text(), text);
    EXPECT_EQ(Json::of_bytes(again.bytes()), again);
    std::istringstream in(text);
    Json read;
    ASSERT_TRUE(Json::parse(in, read));
    EXPECT_EQ(read, again);
  }
}

TEST(Json, BracesMakeObjectsOfPairsThatBeginWithATextAndElseLists) {
  const Json object{{"a", 1}, {"b", {1.5, true, nullptr}}, {"c", {{"d", "e"}}}};
  EXPECT_EQ(object.text(), R"({"a":1,"b":[1.5,true,null],"c":{"d":"e"}})");
  EXPECT_EQ((Json{1, 2}.text()), "[1,2]");
  EXPECT_EQ((Json::array({{"a", 1}, {"b", 2}}).text()), R"([["a",1],["b",2]])");
  EXPECT_EQ((Json{{"a", Json::object()}, {"b", Json::array()}}.text()), R"({"a":{},"b":[]})");
  EXPECT_EQ(Json(std::vector<std::string>{"a", "b"}).text(), R"(["a","b"])");
}

TEST(Json, MembersStayInTheOrderInWhichTheyCame) {
  Json out;
  out["z"] = 1;
  out["a"]["b"] = 2;
  out["z"] = 3;
  out.update({{"m", 4}, {"a", 5}});
  EXPECT_EQ(out.text(), R"({"z":3,"a":5,"m":4})");
  EXPECT_EQ(Json::parse(R"({"a": 1, "b": 2, "a": 3})").text(), R"({"a":3,"b":2})");
  out.erase("a");
  EXPECT_EQ(out.items().size(), 2u);
  EXPECT_EQ(out.find("a"), nullptr);
  EXPECT_EQ(out, Json::parse(R"({"m": 4.0, "z": 3})"));  // ignores order and type of numbers
}

TEST(Json, CopiesAreTheirOwn) {
  Json one{{"list", {1, 2}}, {"text", "a"}};
  Json two = one;
  two["list"].push_back(3);
  two["text"] = "b";
  EXPECT_EQ(one.text(), R"({"list":[1,2],"text":"a"})");
  one = std::move(two);
  EXPECT_EQ(one["list"].back(), 3);
  one = Json(one["list"]);
  EXPECT_EQ(one.text(), "[1,2,3]");
}

TEST(Json, NumbersThatAreNotFiniteBecomeNull) {
  EXPECT_EQ(Json(std::nan("")).text(), "null");
  EXPECT_EQ(Json(-std::numeric_limits<double>::infinity()).text(), "null");
  EXPECT_TRUE(std::isnan(Json::of_bytes(Json(std::nan("")).bytes()).number()));
}

TEST(Json, BytesThatAreNoLettersAreMarkedOrRefused) {
  const Json bad("a\xff");
  EXPECT_EQ(bad.text(), "\"a\xef\xbf\xbd\"");
  EXPECT_THROW((void)bad.exact_text(), JsonError);
  EXPECT_EQ(Json("\u00b5").exact_text(), "\"\xc2\xb5\"");
}

TEST(Json, WhatIsNoJsonIsRefused) {
  Json out;
  for (const char* text : {"", "{", "[1,]", "{\"a\" 1}", "nul", "1 2", "\"a\n\"", "{a: 1}", "01"}) {
    EXPECT_FALSE(Json::parse(text, out)) << text;
    EXPECT_THROW((void)Json::parse(text), JsonError) << text;
  }
  EXPECT_THROW((void)Json::of_bytes("\xff\xff"), JsonError);
}

// A text with a million brackets must not crash the program.
TEST(Json, WhatIsNestedTooDeeplyIsRefused) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_EQ(Json::parse(nested(500)).text(), nested(500));
  Json out;
  for (const std::size_t depth : {501u, 1'000'000u}) {
    EXPECT_FALSE(Json::parse(nested(depth), out));
    EXPECT_THROW((void)Json::parse(nested(depth)), JsonError);
    EXPECT_THROW((void)Json::of_bytes(std::string(depth, '\x81')), JsonError);
  }
}

TEST(Json, AValueIsNotTakenForAnother) {
  const Json json{{"a", 1}, {"b", {1, 2}}, {"c", -1}};
  EXPECT_THROW((void)json.at("d"), JsonError);
  EXPECT_THROW((void)json["a"].string(), JsonError);
  EXPECT_THROW((void)json["b"][2], JsonError);
  EXPECT_THROW((void)json["b"].number(), JsonError);
  EXPECT_THROW((void)json["b"].strings(), JsonError);
  EXPECT_THROW((void)json["c"].natural(), JsonError);
  EXPECT_THROW((void)json["a"].items(), JsonError);
  EXPECT_THROW(Json("a").push_back(1), JsonError);
  EXPECT_THROW((void)Json(std::uint64_t{1} << 63).integer(), JsonError);
  EXPECT_NE(Json(std::uint64_t{1} << 63), Json(std::numeric_limits<std::int64_t>::min()));
  EXPECT_EQ(json.string("a", "none"), "none");
  EXPECT_EQ(Json(1.0), Json(1));
  EXPECT_NE(Json("1"), Json(1));
}

}  // namespace
}  // namespace sinew::json_test
