// Random robots: shipped ones with every number varied, and links added. Each is refused with
// its key, or walks: every number finite, its air accounted for, twice the same bits.
//
// SINEW_GUARD_COUNT: how many; 300 in ./check.
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <iostream>

#include "sinew/run/setup/buildable.h"
#include "tests/guards/subjects.h"
#include "tests/places.h"

namespace sinew::guards {
namespace {

using config::Node;

// SplitMix64: the same robots on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  bool one_in(int n) { return next() % static_cast<std::uint64_t>(n) == 0; }

 private:
  std::uint64_t state_;
};

// Whether a field describes the machine, not its commands nor the resolution of its integration.
bool physical(const NumericField& f) {
  // An option that is absent remains absent: half of one is a contradiction.
  for (const char* option : {".taper.", ".pressure_law."})
    if (f.pattern.find(option) != f.pattern.npos) return false;
  if (f.kind == NumericField::Kind::integer) return f.pattern == "muscle.*.count";
  for (const char* table :
       {"joint.", "muscle.", "link.", "trolley.", "cylinder.", "foot.", "ground.", "actuator.",
        "valve.", "air.", "gravity", "sensor.", "start."})
    if (f.pattern.starts_with(table)) return true;
  return false;
}

// Within its range mostly, sometimes far outside it.
double varied(const NumericField& f, Random& random) {
  const bool narrow = f.unit == "rad" || f.pattern.ends_with(".efficiency");
  const bool rises = f.pattern == "air.polytropic_exponent";  // from just above 1
  const double wide = random.one_in(300) ? 100 : narrow || rises ? 1.05 : 1.4;
  const double factor = std::pow(wide, random.between(rises ? 0 : -1, narrow ? 0 : 1));
  if (random.one_in(1500)) return 0;
  return random.one_in(5000) ? -f.values.front() * factor : f.values.front() * factor;
}

void vary(Node& root, const std::vector<NumericField>& fields, Random& random) {
  const double share = random.unit();
  for (const NumericField& f : fields) {
    if (!physical(f) || f.values.empty() || !std::isfinite(f.values.front())) continue;
    if (random.unit() > share) continue;
    const double value = varied(f, random);
    put(root, f, quantity(f, f.kind == NumericField::Kind::integer ? std::ceil(value) : value));
  }
}

// Passive joints beyond the last one, up to what the format allows.
void hang_on_links(Node& root, Random& random) {
  while (random.one_in(6)) {
    const std::string name = "more" + std::to_string(root.find("link")->children.size());
    const auto number = [&](double low, double high) {
      return units::format_number(random.between(low, high));
    };
    const Node more = config::parse_text(
        "[link." + name + "]\nlength = \"" + number(0.01, 0.1) + " m\"\nmass = \"" +
            number(0.01, 0.2) + " kg\"\ncenter_of_mass = \"0.005 m\"\ninertia = \"" +
            number(1e-5, 1e-4) + " kg m2\"\n[joint." + name +
            "]\nkind = \"passive\"\nrest_angle = \"1 rad\"\ndry_friction = \"" + number(0, 0.05) +
            " N m\"\ndamping = \"" + number(0, 0.01) + " N m s/rad\"\nspring = \"" +
            number(0.1, 1) + " N m/rad\"\nspring_angle = \"1 rad\"\n[start.joint_angles]\n" + name +
            " = \"1 rad\"\n",
        "more.toml");
    config::merge(root, more);
  }
}

bool same_bits(const signals::Table& a, const signals::Table& b) {
  if (a.series.size() != b.series.size()) return false;
  for (std::size_t s = 0; s < a.series.size(); ++s) {
    if (a.series[s].time_ns != b.series[s].time_ns) return false;
    for (std::size_t c = 0; c < a.series[s].columns.size(); ++c)
      if (!std::ranges::equal(
              a.series[s].columns[c], b.series[s].columns[c], {},
              [](double x) { return std::bit_cast<std::uint64_t>(x); },
              [](double x) { return std::bit_cast<std::uint64_t>(x); }))
        return false;
  }
  return true;
}

// Air that entered and has not left is still in the muscle; with hoses, in them or in a muscle.
void expect_air_balance(const experiment::Experiment& e, const signals::Table& table,
                        const std::string& who) {
  double entered = 0, size_of_all = 0;
  bool hoses = false, whole = true;
  for (const robot::Muscle& m : e.robot.muscles) {
    const std::string at = "/true/muscle/" + m.name + "/";
    const auto* mass = table.column(at + "mass");
    const auto* in = table.column(at + "air_in");
    const auto* out = table.column(at + "air_out");
    const auto* leak = table.column(at + "air_leaked");
    if (!mass || mass->empty()) {
      whole = false;
      continue;
    }
    const std::size_t last = mass->size() - 1;
    const double left = (leak ? (*leak)[last] - (*leak)[0] : 0.0);
    const double kept = (*in)[last] - (*in)[0] - ((*out)[last] - (*out)[0]) - left;
    const double size = (*mass)[0] + (*mass)[last] + std::abs((*in)[last]) + std::abs((*out)[last]);
    entered += kept;
    size_of_all += size;
    const bool hose = m.hose.law != gas::Hose::Law::none && m.hose.volume > 0;
    hoses = hoses || hose;
    if (hose) continue;
    EXPECT_NEAR((*mass)[last] - (*mass)[0], kept, 1e-9 * size) << who << ": " << m.name;
  }
  const auto* all = table.column("/true/air/mass");
  if (!hoses || !whole || !all || e.robot.cylinder.present || table.column("/true/supply/pressure"))
    return;
  EXPECT_NEAR(all->back() - all->front(), entered, 1e-9 * size_of_all) << who;
}

struct Count {
  int refused = 0, ended = 0, walked = 0;
  std::map<std::string, int> by;  // keys of the first problems
};

void try_one(const Subject& s, std::uint64_t seed, Count& count) {
  Random random(seed);
  Node root = s.root;
  vary(root, s.fields, random);
  hang_on_links(root, random);
  const std::string who = s.name + " by seed " + std::to_string(seed);
  try {
    const experiment::Experiment e = run::buildable(root, "robot.toml");
    const analysis::Machine machine = analysis::read_machine(root);
    const Ran once = short_run(e, machine), again = short_run(e, machine);
    EXPECT_TRUE(same_bits(once.table, again.table)) << who;
    EXPECT_EQ(once.cause, again.cause) << who;
    if (once.ended) {
      ++count.ended;
      EXPECT_NE(once.cause.find(" at "), std::string::npos) << who << ": " << once.cause;
      return;
    }
    ++count.walked;
    for (const std::string& name : once.not_finite)
      EXPECT_EQ(name, "/desired/foot/position") << who;  // none before the first path
    expect_air_balance(e, once.table, who);
  } catch (const config::Error& refused) {
    ++count.refused;
    ++count.by[refused.problems().front().key];
    for (const config::Problem& p : refused.problems()) {
      EXPECT_FALSE(p.key.empty()) << who << ": " << refused.what();
      EXPECT_FALSE(p.expected.empty()) << who << ": " << refused.what();
      EXPECT_EQ(p.found.find("nan"), std::string::npos) << who << ": " << refused.what();
    }
  } catch (const std::exception& e) {
    ADD_FAILURE() << who << ": " << e.what();
  }
}

TEST(Robots, AtRandomAreRefusedOrWalk) {
  std::vector<Subject> subjects;
  for (const char* name : {"walk-test-1", "cricket", "one-joint", "three-muscles", "walk-3-way",
                           "walk-with-ankle", "walk-with-hoses", "walk-with-pressures",
                           "walk-with-regulators", "cylinder-following", "leg-in-air"})
    subjects.push_back(subject((sinew::test::source_dir() + "/experiments/") + name + ".toml"));

  const char* asked = std::getenv("SINEW_GUARD_COUNT");
  const std::uint64_t tries = asked ? std::strtoull(asked, nullptr, 10) : 300;
  Count count;
  for (std::uint64_t seed = 1; seed <= tries; ++seed)
    try_one(subjects[seed % subjects.size()], seed, count);
  std::cout << tries << " robots: " << count.walked << " walked, " << count.refused
            << " were refused, " << count.ended << " ended early\n";
  if (std::getenv("SINEW_GUARD_COUNT"))
    for (const auto& [key, n] : count.by) std::cout << "  " << n << " by " << key << "\n";
  // If most of them were refused, little would be tested.
  EXPECT_GT(count.walked, static_cast<int>(tries / 4));
}

}  // namespace
}  // namespace sinew::guards
