// Memory does not grow with a run: of a walk of SINEW_GUARD_COUNT simulated seconds the program
// takes as much at its peak as of one of half of them, with a log and without, and so do the
// commands that read the log.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "tests/cli/program.h"

namespace sinew {
namespace {

constexpr double step = 3.03;            // of the walk [s]
constexpr double growth_per_hour = 1e6;  // at most [B]
constexpr double noise = 4e6;            // of a peak: a stride of a log that is read [B]

double seconds() {
  const char* asked = std::getenv("SINEW_GUARD_COUNT");
  return asked ? std::atof(asked) : 7200;  // half of it fills all that a page shows
}

// Runs the program and returns its peak of memory  [B].
double peak_of(const test::Workspace& at, const test::Words& words) {
  const pid_t child = at.start(words);
  int status = 0;
  rusage use{};
  EXPECT_EQ(::wait4(child, &status, 0, &use), child);
  EXPECT_EQ(status, 0) << words.front();
  return 1024.0 * static_cast<double>(use.ru_maxrss);
}

test::Words walk(double lasts, const std::string& folder, const test::Words& more) {
  test::Words words{"run",     "experiments/walk-test-1.toml",
                    "-o",      folder,
                    "--force", "--quiet",
                    "--set",   fmt::format("sequence.repeat={:.0f}", lasts / step),
                    "--set",   "trolley.track_length=1000 m"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Prints what it found, as a line of ./check, and judges it.
void expect_no_growth(const std::string& what, double lasts, double before, double after) {
  const double growth = (after - before) / (lasts / 2) * 3600;
  fmt::print("guard: {:.0f} s of {}: {:.1f} MB, of half of them {:.1f} MB\n", lasts, what,
             1e-6 * after, 1e-6 * before);
  if (lasts >= 3600)
    EXPECT_LT(growth, growth_per_hour) << what;
  else
    EXPECT_LT(after - before, noise) << what;
}

TEST(Memory, DoesNotGrowWithARun) {
  const test::Workspace at;
  const double lasts = seconds();
  const test::Words no_log{"--set", "log.enabled=false"};
  const test::Words some{"--set", "log.channels=[\"/joint\", \"/valve\", \"/plan\"]"};
  const auto peaks = [&](const auto& words_for) {
    const double before = peak_of(at, words_for(lasts / 2, "a"));
    return std::pair{before, peak_of(at, words_for(lasts, "b"))};
  };
  auto [before, after] =
      peaks([&](double of, const std::string& run) { return walk(of, run, no_log); });
  expect_no_growth("a walk without a log", lasts, before, after);

  std::tie(before, after) =
      peaks([&](double of, const std::string& run) { return walk(of, run, some); });
  expect_no_growth("a walk with log and page", lasts, before, after);
  EXPECT_LT(std::filesystem::file_size(at / "b/report.html"), 64e6);

  std::tie(before, after) = peaks([&](double, const std::string& run) {
    return test::Words{"analyze", run, "--json"};
  });
  expect_no_growth("its log analyzed", lasts, before, after);
  std::tie(before, after) = peaks([&](double, const std::string& run) {
    return test::Words{"export", run, "--format", "csv", "-o", run + ".csv"};
  });
  expect_no_growth("its log exported", lasts, before, after);
}

}  // namespace
}  // namespace sinew
