// The fuzzers' inputs, seeds and all that were ever found, checked against the fuzzers' laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "tests/fuzz/law.h"
#include "tests/places.h"

namespace sinew::fuzz {
namespace {

namespace fs = std::filesystem;

struct Harness {
  const char* name;
  void (*run)(std::string_view);
};
void PrintTo(const Harness& harness, std::ostream* out) { *out << harness.name; }

constexpr Harness harnesses[] = {
    {"toml", toml}, {"mcap", mcap}, {"csv", csv},   {"predict", predict}, {"gain", gain},
    {"out", out},   {"set", set},   {"live", live}, {"wire", wire},       {"migrate", migrate}};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class Corpus : public ::testing::TestWithParam<Harness> {};

TEST_P(Corpus, KeepsTheLaws) {
  const fs::path folder =
      fs::path(sinew::test::source_dir()) / "tests/fuzz/corpus" / GetParam().name;
  std::vector<fs::path> files;
  for (const fs::directory_entry& e : fs::directory_iterator(folder)) files.push_back(e.path());
  ASSERT_GE(files.size(), 2u) << folder;
  std::ranges::sort(files);
  for (const fs::path& file : files) EXPECT_NO_THROW(GetParam().run(text_of(file))) << file;
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, ::testing::ValuesIn(harnesses),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace sinew::fuzz
