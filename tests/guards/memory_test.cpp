// Memory does not grow with a run: the program's peak for a walk of SINEW_GUARD_COUNT simulated
// seconds is as large as for a walk of half of them, with a log and without; the same for the
// commands that read the log.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
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
  return asked ? std::atof(asked) : 7200;  // half of it fills all plots of a page
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

struct Peaks {
  double half = 0, whole = 0;  // [B]

  double growth(double lasts) const { return (whole - half) / (lasts / 2) * 3600; }
};

// Measures, prints the result as a line of ./check, and checks it. Libraries that a kernel happens
// to keep mapped count too, by half a megabyte: it is measured up to three times and the smallest
// values are taken. A real growth occurs each time.
template <class WordsFor>
void expect_no_growth(const test::Workspace& at, const std::string& what, double lasts,
                      const WordsFor& words_for) {
  Peaks least{1e300, 1e300};
  const auto grows = [&] {
    return lasts >= 3600 ? !(least.growth(lasts) < growth_per_hour)
                         : !(least.whole - least.half < noise);
  };
  for (int tries = 0; tries == 0 || (tries < 3 && grows()); ++tries) {
    least.half = std::min(least.half, peak_of(at, words_for(lasts / 2, "a")));
    least.whole = std::min(least.whole, peak_of(at, words_for(lasts, "b")));
  }
  fmt::print("guard: {:.0f} s of {}: {:.1f} MB, of half of them {:.1f} MB\n", lasts, what,
             1e-6 * least.whole, 1e-6 * least.half);
  EXPECT_FALSE(grows()) << what << ": " << least.growth(lasts) << " B an hour";
}

TEST(Memory, DoesNotGrowWithARun) {
  const test::Workspace at;
  const double lasts = seconds();
  const test::Words no_log{"--set", "log.enabled=false"};
  const test::Words some{"--set", "log.channels=[\"/joint\", \"/valve\", \"/plan\"]"};
  const auto words = [](const test::Words& first, const std::string& run) {
    test::Words out = first;
    out.insert(out.begin() + 1, run);
    return out;
  };
  expect_no_growth(at, "a walk without a log", lasts,
                   [&](double of, const std::string& run) { return walk(of, run, no_log); });
  expect_no_growth(at, "a walk with log and page", lasts,
                   [&](double of, const std::string& run) { return walk(of, run, some); });
  EXPECT_LT(std::filesystem::file_size(at / "b/report.html"), 64e6);

  expect_no_growth(at, "its log analyzed", lasts, [&](double, const std::string& run) {
    return words({"analyze", "--json"}, run);
  });
  expect_no_growth(at, "its log exported", lasts, [&](double, const std::string& run) {
    return words({"export", "--format", "csv", "--force", "-o", run + ".csv"}, run);
  });
}

}  // namespace
}  // namespace sinew
