// A walk saved at a hundred random instants continues in another process with the same bits.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "tests/places.h"
#include "tests/simulation/seen.h"

namespace sinew::test {
namespace {

TEST(Save, GoesOnInAnotherProcess) {
  namespace fs = std::filesystem;
  const std::string walk = sinew::test::source_dir() + "/experiments/walk-test-1.toml";
  const fs::path folder = fs::temp_directory_path() / ("sinew-save-" + std::to_string(getpid()));
  fs::create_directory(folder);
  const experiment::Experiment e = experiment::load(walk);

  // Up to where seen_to_the_end begins.
  constexpr int saves = 100;
  std::mt19937 random(3);
  std::vector<signals::Tick> instants;
  run::Simulation straight(e);
  for (int i = 0; i < saves; ++i)
    instants.push_back(static_cast<signals::Tick>(
        random() % static_cast<unsigned long>(straight.last() - straight.last() / 20)));
  std::ranges::sort(instants);
  std::string command = sinew::test::build_dir() + "/tests/sinew_go_on" + " " + walk;
  for (int i = 0; i < saves; ++i) {
    straight.advance_to(instants[static_cast<std::size_t>(i)]);
    const std::vector<std::byte> saved = straight.save();
    const fs::path file = folder / (std::to_string(i) + ".save");
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(saved.data()),
               static_cast<std::streamsize>(saved.size()));
    command += " " + file.string();
  }
  char expected[20];
  std::snprintf(expected, sizeof expected, "%016llx",
                static_cast<unsigned long long>(seen_to_the_end(straight)));

  FILE* other = popen(command.c_str(), "r");
  ASSERT_NE(other, nullptr);
  int same = 0;
  std::array<char, 64> line{};
  while (std::fgets(line.data(), line.size(), other) != nullptr)
    same += std::string(line.data()) == std::string(expected) + "\n";
  EXPECT_EQ(WEXITSTATUS(pclose(other)), 0);
  EXPECT_EQ(same, saves);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sinew::test
