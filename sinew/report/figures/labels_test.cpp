#include "sinew/report/figures/labels.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "sinew/report/figures/gnuplot.h"

namespace sinew::report::labels_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

// A temporary file.
struct File {
  explicit File(const std::string& text)
      : path(::testing::TempDir() + "labels-" + std::to_string(::getpid()) + ".toml") {
    std::ofstream(path) << text;
  }
  ~File() { fs::remove(path); }
  std::string path;
};

Labels read(const std::string& text) { return read_labels(File(text).path); }

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const config::Error& e) {
    return e.what();
  }
  return "";
}

const std::string german = R"(format = "sinew.labels/1"
decimal_comma = true
[words]
"joint angles" = "Gelenkwinkel"
"hip" = "Hüfte"
"hip flexor" = "Hüftbeuger"
"desired" = "Soll"
"time" = "Zeit"
[units]
"deg" = "°"
"s" = "s"
)";

TEST(Labels, TranslateTheLongestWordsAndNoPartsOfWords) {
  const Labels labels = read(german);
  EXPECT_EQ(labels.of("hip"), "Hüfte");
  EXPECT_EQ(labels.of("hip desired"), "Hüfte Soll");
  EXPECT_EQ(labels.of("hip flexor, desired"), "Hüftbeuger, Soll");
  EXPECT_EQ(labels.of("ship hips undesired"), "ship hips undesired");
  EXPECT_EQ(labels.of("(hip)"), "(Hüfte)");
  EXPECT_EQ(labels.of("Ühip"), "Ühip") << "a letter of two bytes is a letter";
  EXPECT_EQ(labels.of(""), "");
  EXPECT_EQ(labels.unit("deg"), "°");
  EXPECT_EQ(labels.unit("rad"), "rad");
}

TEST(Labels, ChangeThePictureAndNotTheNumbersBehindIt) {
  Figure figure{.name = "joint-angles",
                .plots = {{.x = {"time", "s"}, .y = {"joint angles", "deg"}}}};
  figure.plots[0].curves = {{.label = "hip desired", .xs = {0, 1}, .ys = {1, 2}}};
  const FigureData numbers = data(figure);
  const std::string text = script(labelled(figure, read(german)), numbers, {Picture::pdf});
  EXPECT_THAT(text, AllOf(HasSubstr("'Zeit [s]'"), HasSubstr("'Gelenkwinkel [°]'"),
                          HasSubstr("'Hüfte Soll'"), HasSubstr("set decimalsign ','"),
                          HasSubstr("'joint-angles.csv'")));
  EXPECT_EQ(numbers.sheets[0].headings,
            (std::vector<std::string>{"time [s]", "hip desired [deg]"}));
}

TEST(Labels, WithoutAFigureAreReportedWithTheNearest) {
  Figure figure{.plots = {{.x = {"time", "s"}, .y = {"joint angles", "deg"}}}};
  FigureTexts phrases;
  phrases.add(figure);
  const auto problems = unused_labels(read(R"(format = "sinew.labels/1"
[words]
"joint angels" = "Gelenkwinkel"
"angles" = "Winkel"
[units]
"degree" = "°"
)"),
                                      phrases);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(config::to_text(problems[0]), AllOf(HasSubstr(".toml:3:"), HasSubstr("joint angels"),
                                                  HasSubstr("\"joint angles\"")));
  EXPECT_THAT(config::to_text(problems[1]), HasSubstr(":6:"));
}

TEST(Labels, OfAFileThatIsNoneAreRefusedWithTheLine) {
  EXPECT_THAT(refusal("x = 1\n"), HasSubstr("format: missing; expected \"sinew.labels/1\""));
  EXPECT_THAT(refusal("format = \"sinew.robot/1\"\n"), HasSubstr("\"sinew.labels/1\""));
  EXPECT_THAT(refusal("format = \"sinew.labels/1\"\n[wrods]\n"),
              AllOf(HasSubstr(":2:"), HasSubstr("\"words\"")));
  EXPECT_THAT(refusal("format = \"sinew.labels/1\"\n[words]\n\"hip\" = 3\n"),
              AllOf(HasSubstr(":3:"), HasSubstr("words.\"hip\": found 3")));
  EXPECT_THAT(refusal("format = \"sinew.labels/1\"\nwords = \"hip\"\n"), HasSubstr("a table"));
  EXPECT_THAT(refusal("format = \"sinew.labels/1\"\ndecimal_comma = \"yes\"\n"),
              HasSubstr("true or false"));
  EXPECT_THAT(refusal("format = \"sinew.labels/1\"\n[words]\nhip = \"a\"\nhip = \"b\"\n"),
              HasSubstr(":4:"));
  EXPECT_THROW(read_labels("/nowhere/labels.toml"), config::Error);
}

TEST(Labels, HaveAFileToBeginWithThatChangesNothing) {
  Figure figure{.plots = {{.x = {"time", "s"}, .y = {"say \"it\" \\ so", "bar gauge"}}}};
  figure.plots[0].curves = {{.label = "hip"}, {.label = "hip desired"}, {.label = "knee desired"}};
  FigureTexts phrases;
  phrases.add(figure);
  const std::string text = labels_file(phrases);
  EXPECT_THAT(text,
              AllOf(StartsWith("format = \"sinew.labels/1\""), HasSubstr("\"hip\" = \"hip\""),
                    HasSubstr("\"desired\" = \"desired\""), HasSubstr("\"knee\" = \"knee\"")));
  const Labels labels = read(text);
  EXPECT_TRUE(unused_labels(labels, phrases).empty());
  for (const std::string& word : phrases.words) EXPECT_EQ(labels.of(word), word);
  EXPECT_EQ(labels.units.size(), 2u);
}

}  // namespace
}  // namespace sinew::report::labels_test
