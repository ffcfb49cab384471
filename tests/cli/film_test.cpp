// `film`: of a machine, of the stand and of several runs, where there is a browser. Errors before
// a browser is started: film.txt.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/cli/program.h"

namespace sinew::test::film_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

const std::string bench = "experiments/one-joint.toml";
const std::string stand = "experiments/rig/feedback.toml";

// Returns whether the shell finds one of these programs.
bool is_installed(const std::string& programs) {
  return std::system(("for p in " + programs +
                      "; do command -v $p && exit 0; done >/dev/null; "
                      "exit 1")
                         .c_str()) == 0;
}

bool can_film() {
  return SINEW_HAS_PAGE && is_installed("python3") &&
         is_installed(
             "${CHROMIUM:-chromium-headless-shell chromium chromium-browser google-chrome "
             "google-chrome-stable}");
}

void run(const Workspace& w, const std::string& experiment, const std::string& folder) {
  ASSERT_EQ(w.sinew({"run", experiment, "-o", folder, "--no-report"}).code, 0);
}

// Content of a GIF, read block by block.
struct Gif {
  int width = 0, height = 0, unlike = 0;
  std::vector<int> delays;  // of each frame [ms]

  explicit Gif(const std::string& bytes);
};

Gif::Gif(const std::string& bytes) {
  const auto at = [&](std::size_t i) {
    return static_cast<int>(static_cast<unsigned char>(bytes.at(i)));
  };
  const auto word = [&](std::size_t i) { return at(i) + 256 * at(i + 1); };
  EXPECT_THAT(bytes, StartsWith("GIF89a"));
  width = word(6);
  height = word(8);
  std::size_t i = 13 + 3 * (std::size_t{2} << (at(10) & 7));
  std::string before;
  while (at(i) != 0x3B) {
    const bool image = at(i) == 0x2C;
    if (!image && at(i + 1) == 0xF9) delays.push_back(10 * word(i + 4));
    i += image ? 11 : 2;  // no table of its own
    std::string data;
    for (; at(i) != 0; i += static_cast<std::size_t>(at(i)) + 1)
      data += bytes.substr(i + 1, static_cast<std::size_t>(at(i)));
    ++i;
    if (image && data != before) ++unlike;
    if (image) before = data;
  }
}

TEST(Film, OfAMachineIsAGifOfSoManyFrames) {
  if (!can_film()) GTEST_SKIP() << "no chromium, or built without the page";
  const Workspace w;
  run(w, bench, "run");
  const Words film{"film",  "run", "-o",      "a.gif", "--from",   "0.5 s", "--to",    "1 s",
                   "--fps", "30",  "--width", "320",   "--height", "241",   "--speed", "0.5"};
  const Result made = w.sinew(film);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.out, "");
  EXPECT_THAT(made.err, HasSubstr("a.gif, 30 frames, 1.0 s"));
  const Gif gif(read_text(w / "a.gif"));
  EXPECT_EQ(gif.width, 320);
  EXPECT_EQ(gif.height, 241);
  ASSERT_EQ(gif.delays.size(), 30u);
  int all = 0;
  for (const int delay : gif.delays) all += delay;
  EXPECT_EQ(all, 1000) << "30 frames in a second, though a GIF counts hundredths";
  EXPECT_GE(gif.unlike, 20) << "it moves";

  EXPECT_THAT(w.sinew(film).err, HasSubstr("--force"));
  Words again = film;
  again[3] = "b.gif";
  ASSERT_EQ(w.sinew(again).code, 0);
  EXPECT_TRUE(read_text(w / "a.gif") == read_text(w / "b.gif")) << "the same bytes again";
}

TEST(Film, OfTheStandIsAVideo) {
  if (!can_film()) GTEST_SKIP() << "no chromium, or built without the page";
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "ffmpeg is missing";
  const Workspace w;
  run(w, stand, "run");
  const Result made = w.sinew({"film", "run", "-o", "stand.mp4", "--to", "0.4 s", "--width", "320",
                               "--height", "240", "--dark"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(read_text(w / "stand.mp4").substr(4, 4), "ftyp");
  EXPECT_FALSE(fs::exists(w / "stand.mp4.unfinished"));
  if (!is_installed("ffprobe")) return;
  const std::string ask =
      "ffprobe -v error -count_frames -show_entries stream=width,nb_read_frames"
      " -of csv=p=0 '" +
      (w / "stand.mp4").string() + "' > '" + (w / "asked").string() + "'";
  ASSERT_EQ(std::system(ask.c_str()), 0);
  EXPECT_THAT(read_text(w / "asked"), StartsWith("320,10"));
}

// A recording of angles alone, of a bench with a different motion, over the simulation.
void run_both(const Workspace& w) {
  run(w, bench, "simulated");
  ASSERT_EQ(w.sinew({"run", bench, "-o", "measured", "--no-report", "--set",
                     "log.channels=[\"/joint/*/angle\"]", "--set",
                     "joint.lever.damping=0.7 lbf in s/rad"})
                .code,
            0);
}

TEST(Film, OfAComparisonShowsTheGhostAndWhoIsWho) {
  if (!can_film()) GTEST_SKIP() << "no chromium, or built without the page";
  const Workspace w;
  run_both(w);
  const auto film = [&](Words of, const std::string& file) {
    of.insert(of.begin(), "film");
    for (const char* more : {"--from", "0.5 s", "--to", "0.9 s", "--fps", "20", "--width", "320",
                             "--height", "240", "-o", file.c_str()})
      of.emplace_back(more);
    return w.sinew(of);
  };
  const Result made = film({"simulated", "measured", "--align", "correlation"}, "both.gif");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("both.gif, 8 frames, 0.4 s"));
  const Gif gif(read_text(w / "both.gif"));
  EXPECT_EQ(gif.width, 320);
  EXPECT_EQ(gif.delays.size(), 8u);
  EXPECT_GE(gif.unlike, 6) << "it moves";

  // Differs from a film of the first run over itself, whose ghost is hidden.
  ASSERT_EQ(film({"simulated", "measured"}, "start.gif").code, 0);
  ASSERT_EQ(film({"simulated", "simulated/log.mcap"}, "same.gif").code, 0);
  ASSERT_EQ(film({"simulated"}, "alone.gif").code, 0);
  const std::string both = read_text(w / "start.gif");
  EXPECT_FALSE(both == read_text(w / "same.gif"));
  EXPECT_FALSE(both == read_text(w / "alone.gif"));
  ASSERT_EQ(film({"simulated", "measured"}, "again.gif").code, 0);
  EXPECT_TRUE(both == read_text(w / "again.gif")) << "the same bytes again";
}

TEST(Film, OfAComparisonRefusesARunThatCannotBeDrawn) {
  if (!can_film()) GTEST_SKIP() << "no chromium, or built without the page";
  const Workspace w;
  run(w, bench, "run");
  ASSERT_EQ(w.sinew({"run", bench, "-o", "blind", "--no-report", "--set",
                     "log.channels=[\"/muscle/*/tension\"]"})
                .code,
            0);
  EXPECT_THAT(w.sinew({"film", "run", "blind", "-o", "a.gif"}).err,
              AllOf(StartsWith("blind: "), HasSubstr("a run without a drawing")));
}

TEST(Film, OfATimeThatTheRunDoesNotHaveIsRefused) {
  if (!can_film()) GTEST_SKIP() << "no chromium, or built without the page";
  const Workspace w;
  for (const char* folder : {"run", "from"}) {  // the name of the option, too
    run(w, bench, folder);
    const Result refused = w.sinew({"film", folder, "-o", "a.gif", "--from", "1000 s"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, AllOf(StartsWith("--from: "), HasSubstr("a time of the run")));
  }
}

}  // namespace
}  // namespace sinew::test::film_test
