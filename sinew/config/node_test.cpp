// Conversion of TOML text to the tree, and texts of messages.
#include "sinew/config/node.h"

#include <gtest/gtest.h>

#include "sinew/config/compose.h"
#include "sinew/config/utf8.h"

namespace sinew::config::node_test {
namespace {

std::string message(std::string_view toml) {
  try {
    parse_text(toml, "file.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Node, KeepsOrderKindAndPlace) {
  const Node root = parse_text(
      "zebra = 1\napple = \"two\"\n[muscle.b]\nx = 0.5\n[muscle.a]\ny = true\n", "file.toml");
  EXPECT_EQ(keys_of(root), (std::vector<std::string_view>{"zebra", "apple", "muscle"}));
  EXPECT_EQ(keys_of(*root.find("muscle")), (std::vector<std::string_view>{"b", "a"}));
  EXPECT_EQ(root.find("zebra")->integer, 1);
  EXPECT_EQ(root.find("apple")->text, "two");
  const Node& x = *root.find("muscle")->find("b")->find("x");
  EXPECT_EQ(x.real, 0.5);
  EXPECT_EQ(x.where.file, "file.toml");
  EXPECT_EQ(x.where.line, 4);
  EXPECT_EQ(x.where.column, 1);
  EXPECT_FALSE(x.used);
}

TEST(Node, ListsHaveNoKeys) {
  const Node root = parse_text("range = [\"1 in\", 2, [true]]", "file.toml");
  const Node& range = *root.find("range");
  ASSERT_EQ(range.children.size(), 3u);
  EXPECT_EQ(written(range), "1 in, 2, true");
  EXPECT_EQ(range.find(""), nullptr);
}

TEST(Node, ASyntaxErrorHasAPlace) {
  const std::string text = message("a = 1\nb = [1, 2\n");
  EXPECT_EQ(text.substr(0, 10), "file.toml:");
  EXPECT_NE(text.find("found a syntax error"), std::string::npos);
  EXPECT_NE(text.find("; expected TOML"), std::string::npos);
}

TEST(Node, AQuantityWithoutQuotesGetsTheHint) {
  const std::string said = message("mount_length = 7.2 mm  # of the hip\n");
  EXPECT_NE(said.find("try quotes around a quantity: mount_length = \"7.2 mm\""), std::string::npos)
      << said;
}

TEST(Node, ANumberThatNothingHoldsIsNoQuantityWithoutQuotes) {
  for (const char* number : {"9223372036854775808", "-9223372036854775809", "1e400"}) {
    const std::string said = message("seed = " + std::string(number) + "\n");
    EXPECT_NE(said.find("try a number of another size"), std::string::npos) << said;
  }
}

TEST(Node, AKeyGivenTwiceIsAnError) { EXPECT_NE(message("a = 1\na = 2\n"), "no error"); }

TEST(Node, ADateIsAnError) {
  EXPECT_NE(message("a = 2000-05-01\n").find("found a date"), std::string::npos);
}

TEST(Node, AMissingFileIsAnError) {
  try {
    parse_file("no/such/file.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no/such/file.toml: found no readable file; expected a TOML file");
  }
}

TEST(Node, MergingGoesIntoTablesAndReplacesValues) {
  Node base = parse_text("[t]\na = 1\nb = { value = \"1 m\", source = \"old\" }\n", "base.toml");
  merge(base, parse_text("[t]\nb = { value = \"2 m\" }\nc = 3\n", "own.toml"));
  const Node& t = *base.find("t");
  EXPECT_EQ(keys_of(t), (std::vector<std::string_view>{"a", "b", "c"}));
  EXPECT_EQ(t.find("b")->find("source"), nullptr);  // the old source does not apply to 2 m
  EXPECT_EQ(t.find("b")->where.file, "own.toml");
}

std::string times(int n, const std::string& text) {
  std::string out;
  for (int i = 0; i < n; ++i) out += text;
  return out;
}

// The library and the tree call themselves once per level.
TEST(ParseText, DeepNestingIsRefusedWithItsPlace) {
  const std::string many = times(10000, "a.") + "a";
  for (const std::string& text :
       {many + " = 1", "[" + many + "]\nx = 1", "[[" + many + "]]", "x = { " + many + " = 1 }",
        "x = " + times(10000, "[") + times(10000, "]"),
        "x = " + times(10000, "{ a = ") + "1" + times(10000, "}"), "x = " + times(10000, "[\n")}) {
    try {
      parse_text("format = \"sinew.robot/1\"\n" + text, "deep.toml");
      ADD_FAILURE() << text.substr(0, 40);
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("more than 100 levels"), std::string::npos) << e.what();
      EXPECT_GE(e.problems().front().where.line, 2);
    }
  }
  Node root = make_table("");
  EXPECT_THROW(apply_set(root, many + "=1"), Error);
}

// Neither texts and comments nor numbers are nesting.
TEST(ParseText, DotsAndBracketsInTextsAreNotNesting) {
  const std::string dots = times(300, ".["),
                    text = "a = \"\\\"" + dots + "\" # " + dots + "\nb = '''\n" + dots +
                           "\n''' # it's\nc = [\n" +
                           times(300, "  1.5, [2.5], { d = 3.5 }, 'it',\n") + "]\n";
  EXPECT_EQ(parse_text(text, "flat.toml").find("c")->children.size(), 1200U);
}

TEST(Diagnostics, AProblemIsOneLine) {
  Problem problem;
  problem.where = {"a.toml", 3, 7};
  problem.key = "x.y";
  problem.found = "\"3\"";
  problem.expected = "m (length)";
  problem.try_this = "\"3 m\"";
  EXPECT_EQ(to_text(problem), "a.toml:3:7: x.y: found \"3\"; expected m (length); try \"3 m\"");
  EXPECT_EQ(to_text(std::vector{problem, problem}), to_text(problem) + "\n" + to_text(problem));
}

// A file or its name may contain control characters of a terminal, bidirectional characters
// or bytes that are not UTF-8.
TEST(Diagnostics, BytesThatAreNoTextAreShownAsNumbers) {
  const Problem problem{{"a.toml", 1, 1}, "x", in_quotes("1\n2\x1b[31m\x7f"), "a number"};
  EXPECT_EQ(to_text(problem), "a.toml:1:1: x: found \"1\\x0A2\\x1B[31m\\x7F\"; expected a number");
  const Problem file{{"caf\xE9\xE2\x80\xAE.toml", 1, 1}, "\xC3\xA4", "1", "2"};
  EXPECT_EQ(to_text(file), "caf\\xE9\\xE2\\x80\\xAE.toml:1:1: \xC3\xA4: found 1; expected 2");
  EXPECT_EQ(printable("a\xC2\x9B"
                      "1m\x7F\x1B\t\xC2\xA0"),
            "a\\xC2\\x9B"
            "1m\\x7F\\x1B\t\xC2\xA0");
  EXPECT_EQ(without_controls("a\xC2\x9B"
                             "1m\x7F\x1B\t\xC2\xA0\xE2\x80\xAE"),
            "a1m\t\xC2\xA0");
}

TEST(Diagnostics, SuggestsOnlyWhatIsNear) {
  EXPECT_EQ(closest("mount_lenght", {"mount_length", "moment_arm"}), "mount_length");
  EXPECT_EQ(closest("hip_flexr", {"hip_flexor", "knee_flexor"}), "hip_flexor");
  EXPECT_EQ(closest("x", {"y"}), "");
  EXPECT_EQ(closest("temperature", {"pressure"}), "");
  EXPECT_EQ(either({"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(in_quotes(std::string(100, 'x')).size(), 60 + 2 + std::string("…").size());
}

}  // namespace
}  // namespace sinew::config::node_test
