#include "sinew/film/film.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sinew/config/diagnostics.h"
#include "sinew/film/process.h"

namespace sinew::film::film_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

std::string refusal(const FilmOptions& options, Kind kind = Kind::gif) {
  try {
    check(options, kind);
  } catch (const config::Error& e) {
    return e.what();
  }
  return "";
}

TEST(Film, IsOfTheKindThatItsFileSays) {
  EXPECT_EQ(kind_of("a/walk.gif"), Kind::gif);
  EXPECT_EQ(kind_of("walk.mp4"), Kind::mp4);
  EXPECT_EQ(kind_of("walk.webm"), Kind::webm);
  for (const char* file : {"walk.avi", "walk", "walk.gif.txt"}) {
    try {
      kind_of(file);
      ADD_FAILURE() << file;
    } catch (const config::Error& e) {
      EXPECT_THAT(std::string(e.what()), AllOf(HasSubstr(file), HasSubstr(".gif, .mp4 or .webm")));
    }
  }
}

TEST(Film, RefusesWhatCannotBeShown) {
  EXPECT_EQ(refusal({}), "");
  EXPECT_THAT(refusal({.from = 3, .to = 2}), StartsWith("from: found 3 s; expected a time before"));
  EXPECT_THAT(refusal({.width = 10}), StartsWith("width: found 10; expected 100 to 3840 pixels"));
  EXPECT_THAT(refusal({.height = 100000}), StartsWith("height: "));
  EXPECT_THAT(refusal({.frames_per_second = 60}), StartsWith("fps: found 60; expected 1 to 50"));
  EXPECT_EQ(refusal({.frames_per_second = 60}, Kind::mp4), "");
  EXPECT_THAT(refusal({.width = 881}, Kind::mp4), HasSubstr("even number of pixels"));
  EXPECT_EQ(refusal({.width = 881}), "");
  for (const double speed : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(refusal({.speed = speed}), StartsWith("speed: ")) << speed;
}

// --- programs ---

TEST(Process, IsGivenAPipeAndItsLastWordsAreKept) {
  const fs::path words = fs::path(::testing::TempDir()) / ("words-" + std::to_string(::getpid()));
  Pipe pipe = Pipe::make();
  const pid_t pid = start({"/bin/sh", "-c", "cat <&3; echo one >&2; echo two >&2; exit 3"},
                          {{pipe.read.file(), 3}}, words);
  pipe.read.close();
  EXPECT_TRUE(write_all(pipe.write.file(), "through the pipe\n"));
  EXPECT_FALSE(ends_within(pid, 0.05)) << "it reads until nobody writes";
  pipe.write.close();
  EXPECT_TRUE(ends_within(pid, 10));
  EXPECT_EQ(wait_for(pid), 3);
  EXPECT_EQ(last_words(words), "one; two");
  fs::remove(words);
}

TEST(Process, ThatIsGoneIsNoticedByTheWriter) {
  const fs::path words = fs::path(::testing::TempDir()) / ("gone-" + std::to_string(::getpid()));
  Pipe pipe = Pipe::make();
  const pid_t pid = start({"/bin/sh", "-c", "exit 0"}, {{pipe.read.file(), 3}}, words);
  pipe.read.close();
  EXPECT_EQ(wait_for(pid), 0);
  EXPECT_FALSE(write_all(pipe.write.file(), std::string(1 << 20, 'x')));
  fs::remove(words);
}

TEST(Chromium, ThatIsMissingOrNoneIsToldWithWhatToDo) {
  std::atomic<bool> stop{false};
  const auto told = [&] {
    try {
      Chromium browser(stop);
      browser.evaluate("1");
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  unsetenv("CHROMIUM");
  EXPECT_THAT(told(), AllOf(HasSubstr("apt-get install chromium"), HasSubstr("CHROMIUM=")));
  setenv("PATH", path.c_str(), 1);
  setenv("CHROMIUM", "/nowhere/chromium", 1);
  EXPECT_THAT(told(), HasSubstr("/nowhere/chromium"));
  setenv("CHROMIUM", "/bin/true", 1);
  EXPECT_THAT(told(), AllOf(HasSubstr("/bin/true"), HasSubstr("ended")));
  unsetenv("CHROMIUM");
}

}  // namespace
}  // namespace sinew::film::film_test
