// `sinew doctor` by the program: what it finds is this computer's, so that only its form is fixed.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::doctor_test {
namespace {

using ::testing::HasSubstr;

TEST(Doctor, ASimulationNeedsNothingAndEachFindingSaysWhatWhyAndWhatToDo) {
  const Workspace w;
  const Result result = w.sinew({"doctor", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto all = nlohmann::json::parse(result.out);
  EXPECT_EQ(all["format"], "sinew.doctor/1");
  EXPECT_EQ(all["place"], "simulated");
  EXPECT_EQ(all["ready"], true);
  std::set<std::string> subjects;
  for (const auto& f : all["findings"]) {
    subjects.insert(f["subject"]);
    EXPECT_NE(f["found"], "");
    EXPECT_NE(f["why"], "");
    EXPECT_EQ(f.contains("todo"), f["verdict"] != "good") << f;
  }
  for (const char* subject : {"serial devices", "cards", "libcomedi", "qemu-system-arm", "kernel",
                              "real-time priority", "locked memory", "timer latency"})
    EXPECT_TRUE(subjects.contains(subject)) << subject;
}

TEST(Doctor, ExitsAsItsFindingsSayOfThePlace) {
  const Workspace w;
  for (const char* place : {"serial", "emulated", "comedi"}) {
    const Result result = w.sinew({"doctor", "--for", place, "--json"});
    const auto all = nlohmann::json::parse(result.out);
    EXPECT_EQ(result.code, all["ready"] == true ? 0 : 1) << place;
    std::map<std::string, bool> missing;  // by subject: is nothing of it good?
    for (const auto& f : all["findings"])
      if (f.value("place", "") == place) {
        const auto at = missing.emplace(f["subject"], true).first;
        if (f["verdict"] != "missing") at->second = false;
      }
    const bool ready = std::ranges::none_of(missing, [](const auto& m) { return m.second; });
    EXPECT_EQ(ready, all["ready"] == true) << place;
  }
}

TEST(Doctor, APlaceThatThereIsNotIsWrongUsage) {
  const Workspace w;
  const Result result = w.sinew({"doctor", "--for", "mars"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--for"));
}

}  // namespace
}  // namespace sinew::test::doctor_test
