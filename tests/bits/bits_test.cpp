// Bit-for-bit regression: every reading, every valve edge and the whole true motion of the
// experiments that "First light" shipped. A deliberate change of them (a law, a calibration)
// changes golden.txt in the same commit; an added part of the machine must not change them.
//
// golden.txt: experiment, FNV-1a of times and values. The test prints the values it computed where
// they differ.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      value_ = (value_ ^ ((word >> (8 * byte)) & 0xff)) * 0x100000001b3ull;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

// The topics that a run had then, by prefix and last part of their names.
bool of_first_light(const std::string& topic) {
  const auto ends = [&](std::initializer_list<const char*> tails) {
    for (const char* tail : tails)
      if (topic.ends_with(tail)) return true;
    return false;
  };
  if (topic.starts_with("/sensor/")) return ends({"/count"});
  if (topic.starts_with("/valve/")) return ends({"/inlet/open", "/exhaust/open"});
  if (topic.starts_with("/true/joint/")) return ends({"/angle", "/velocity", "/torque"});
  if (topic.starts_with("/true/trolley/")) return ends({"/position", "/velocity"});
  if (topic.starts_with("/true/foot/")) return ends({"foot/position", "foot/force"});
  return topic.starts_with("/true/muscle/") &&
         ends({"/tension", "/pressure", "/length", "/mass", "/air_in", "/air_out"});
}

std::uint64_t hash_of(const signals::Table& table) {
  std::map<std::string, const signals::Series*> sorted;
  for (const signals::Series& s : table.series)
    if (of_first_light(s.topic.name)) sorted[s.topic.name] = &s;
  Hash hash;
  for (const auto& [name, series] : sorted) {
    for (const char c : name) hash.add(static_cast<unsigned char>(c));
    for (const std::int64_t t : series->time_ns) hash.add(static_cast<std::uint64_t>(t));
    for (const auto& column : series->columns)
      for (const double x : column) hash.add(std::bit_cast<std::uint64_t>(x));
  }
  return hash.value();
}

// Undoes later changes of an experiment.
std::vector<std::string> of_the_first_day(const std::string& experiment) {
  if (experiment == "no-drag") return {"trolley.drag=0 lbf"};
  return {};
}

TEST(Bits, OfFirstLightAreKept) {
  std::ifstream golden(sinew::test::source_dir() + "/tests/bits/golden.txt");
  std::string name, wanted;
  int experiments = 0;
  for (; golden >> name >> wanted; ++experiments) {
    const auto e = experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml",
                                    of_the_first_day(name));
    char found[17];
    std::snprintf(found, sizeof found, "%016llx",
                  static_cast<unsigned long long>(hash_of(run::run(e).table)));
    EXPECT_EQ(found, wanted) << name;
  }
  EXPECT_EQ(experiments, 8);
}

}  // namespace
}  // namespace sinew
