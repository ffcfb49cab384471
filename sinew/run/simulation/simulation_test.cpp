// A run that the caller controls equals run(), bit for bit, however it is advanced, read and
// restored.
#include "sinew/run/simulation/simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>

#include "sinew/config/node.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::run::simulation_test {
namespace {

using signals::Tick;

const std::string source = sinew::test::source_dir();

// The experiments for all tests of this file: every mechanism, every kind of air, a controller with
// a state, and faulty sensors.
struct Kind {
  std::string file;
  std::vector<std::string> sets;
};
const std::vector<Kind> kinds{
    {"walk-test-1", {}},
    {"derivative-control", {}},
    {"walk-with-hoses", {}},
    {"walk-with-regulators", {}},
    {"walk-two-legs", {}},
    {"walk-two-legs", {"joint.right_hip.board=2", "joint.right_knee.board=2"}},
    {"cylinder-following", {}},
    {"faults/sensor-open", {}},
    {"ground-force", {}},
    {"leg-in-air",
     {"change=[{ time = \"1 s\", key = \"control.stiffness.hip\", value = \"3 N m/rad\" }]"}},
};

experiment::Experiment load(const Kind& kind) {
  std::vector<std::string> sets = kind.sets;
  sets.push_back("sequence.repeat=1");
  return experiment::load(source + "/experiments/" + kind.file + ".toml", sets);
}

std::vector<double> all(Simulation& s) {
  std::vector<double> out;
  for (std::size_t c = 0; c < s.channels().size(); ++c) out.push_back(s.read(c));
  return out;
}

void expect_same(Simulation& a, Simulation& b) {
  ASSERT_EQ(a.tick(), b.tick());
  const std::vector<double> x = all(a), y = all(b);
  for (std::size_t c = 0; c < x.size(); ++c)
    ASSERT_TRUE(x[c] == y[c] || (std::isnan(x[c]) && std::isnan(y[c])))
        << a.channels()[c].name << " at tick " << a.tick() << ": " << x[c] << " " << y[c];
}

TEST(Simulation, InPortionsAndLookedAtHasTheSameBits) {
  std::mt19937 random(1);
  for (const Kind& kind : kinds) {
    const experiment::Experiment e = load(kind);
    Simulation straight(e), portions(e);
    const Tick stops[] = {straight.last() / 3, straight.last() / 2 + 7, straight.last()};
    for (const Tick stop : stops) {
      straight.advance_to(stop);
      while (portions.tick() < stop && !portions.ended()) {
        portions.advance_to(std::min<Tick>(stop, portions.tick() + 1 + random() % 300));
        if (random() % 3 == 0) (void)portions.read(random() % portions.channels().size());
      }
      expect_same(straight, portions);
    }
    EXPECT_TRUE(portions.ended()) << kind.file;
  }
}

// A sample of run() is taken at its own tick; a simulation that was advanced beyond that tick
// has the same state.
TEST(Simulation, ReceivesAndReportsWhatARunDoes) {
  const experiment::Experiment e = load(kinds[0]);
  const Outcome whole = run(e);
  Simulation s(e);
  for (const char* name : {"/joint/hip/angle", "/desired/joint/knee/angle", "/plan/phase",
                           "/muscle/hip_flexor/tension"}) {
    const signals::Series* series = whole.table.find(name);
    ASSERT_NE(series, nullptr) << name;
    Simulation other(e);
    for (std::size_t i = 0; i < series->time_ns.size(); i += 40) {
      other.advance_to(series->time_ns[i] / signals::tick_nanoseconds + 1);
      ASSERT_EQ(other.read(name), series->columns[0][i]) << name << " " << i;
    }
  }
}

TEST(Simulation, GoesOnFromASaveWithTheSameBits) {
  std::mt19937 random(2);
  for (const Kind& kind : kinds) {
    const experiment::Experiment e = load(kind);
    Simulation straight(e);
    auto held = std::make_unique<Simulation>(e);
    straight.advance_to(straight.last());
    for (int i = 0; i < 25 && !held->ended(); ++i) {
      held->advance_to(held->tick() + 1 + random() % (straight.last() / 20));
      const std::vector<std::byte> saved = held->save();
      held->advance_by(0.05);  // the discarded part leaves no trace
      if (i % 2 == 0) {
        held->restore(saved);
      } else {
        auto other = std::make_unique<Simulation>(e);
        if (i % 3 == 0) other->advance_by(0.2);
        other->restore(saved);
        held = std::move(other);
      }
    }
    held->advance_to(held->last());
    expect_same(straight, *held);
    EXPECT_EQ(straight.finish(), held->finish()) << kind.file;
  }
}

// A save does not depend on the place of the experiment's files.
TEST(Simulation, ASaveIsThatOfTheResolvedExperimentToo) {
  for (const Kind& kind : kinds) {
    const experiment::Experiment e = load(kind);
    const experiment::Experiment again = buildable(
        config::parse_text(experiment::resolved(e, "any"), "resolved.toml"), "resolved.toml");
    Simulation there(e), here(again);
    there.advance_by(1.0);
    here.restore(there.save());
    for (Simulation* s : {&there, &here}) s->advance_by(0.5);
    expect_same(there, here);
  }
}

// A request that has not taken effect is part of the save.
TEST(Simulation, WishesOnTheirWayAreSaved) {
  const experiment::Experiment e = load(kinds[0]);
  Simulation a(e), b(e);
  a.advance_to(12345);
  a.change("control.stiffness.hip", 1.5);
  b.restore(a.save());
  for (Simulation* s : {&a, &b}) s->advance_to(12500);
  EXPECT_EQ(a.read("/desired/joint/hip/stiffness"), 1.5);
  expect_same(a, b);
}

// The experiment's own list [[change]] has the same effect.
TEST(Simulation, AChangeIsThatOfTheExperimentsList) {
  experiment::Experiment e = load({"leg-in-air", {}});
  Simulation held(e);
  held.advance_to(15000);
  held.change("control.stiffness.knee", 1.25);
  held.advance_to(20000);
  held.change("control.gains.hip.angle", 0.001);
  held.release("control.stiffness.knee");
  held.advance_to(held.last());

  e.plan.changes = {{.time = 1.5, .key = "control.stiffness.knee", .value = 1.25},
                    {.time = 2.0, .key = "control.gains.hip.angle", .value = 0.001},
                    {.time = 2.0, .key = "control.stiffness.knee", .release = true}};
  Simulation listed(e), plain(load({"leg-in-air", {}}));
  for (Simulation* s : {&listed, &plain}) s->advance_to(s->last());
  expect_same(held, listed);
  EXPECT_NE(all(held), all(plain));
}

// Settings and channels selected by number equal those selected by name.
TEST(Simulation, NumbersStandForNames) {
  const experiment::Experiment e = load({"walk-test-1", {}});
  Simulation by_name(e), by_number(e);
  by_name.advance_by(1.0);
  by_number.advance_by(1.0);
  const std::size_t hip = by_number.find_setting("control.stiffness.hip");
  EXPECT_NEAR(by_number.value_of(hip), 35 * 0.112984829, 1e-6);  // 35 lbf in/rad
  by_name.change("control.stiffness.hip", 2.5);
  by_number.change(hip, 2.5);
  by_name.advance_by(0.5);
  by_number.advance_by(0.5);
  EXPECT_EQ(by_number.value_of(hip), 2.5);

  std::vector<std::size_t> every(by_number.channels().size());
  std::iota(every.begin(), every.end(), 0u);
  std::vector<double> values(every.size());
  by_number.read(every, values);
  EXPECT_EQ(values, all(by_name));
  EXPECT_THROW(by_number.change(hip, -1), std::invalid_argument);
}

TEST(Simulation, ReportsWhyItEndedEarly) {
  experiment::Experiment e = load({"walk-test-1", {}});
  Simulation whole(e);
  whole.advance_to(whole.last());
  EXPECT_TRUE(whole.ended());
  EXPECT_EQ(whole.cause(), "");

  for (robot::Muscle& m : e.robot.muscles)
    if (m.name == "knee_extensor") m.bladder_stiffness = 1e8;
  Simulation runs_away(e);
  runs_away.advance_to(runs_away.last());
  EXPECT_TRUE(runs_away.ended());
  EXPECT_NE(runs_away.cause().find("plant_steps.body"), std::string::npos) << runs_away.cause();
}

std::string refusal(auto&& what) {
  try {
    what();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "nothing";
}

TEST(Simulation, RefusesWhatIsNoSaveOfItsOwn) {
  Simulation s(load(kinds[0]));
  s.advance_by(1.0);
  const std::vector<std::byte> good = s.save();
  const std::vector<double> before = all(s);

  std::vector<std::byte> bad(good.begin(), good.end() - 1);
  EXPECT_EQ(refusal([&] { s.restore(bad); }), "save: found it cut off or spoilt");
  bad = good;
  bad[bad.size() / 2] ^= std::byte{1};
  EXPECT_EQ(refusal([&] { s.restore(bad); }), "save: found it cut off or spoilt");
  for (std::size_t bit = 0; bit < 8 * good.size(); bit += bit < 8 * 40 ? 1 : 997) {
    bad = good;
    bad[bit / 8] ^= std::byte(1 << bit % 8);
    EXPECT_NE(refusal([&] { s.restore(bad); }), "nothing") << "the header's bits and some behind";
  }
  bad.resize(10);
  EXPECT_EQ(refusal([&] { s.restore(bad); }), "save: found too few bytes for one");
  bad.assign(5000, std::byte{'x'});
  EXPECT_NE(refusal([&] { s.restore(bad); }).find("expected what Simulation::save gave"),
            std::string::npos);
  Simulation heavier(load({"walk-test-1", {"trolley.payload=1 kg"}}));
  EXPECT_NE(refusal([&] { heavier.restore(good); }).find("another experiment"), std::string::npos);
  EXPECT_EQ(all(s), before);

  EXPECT_NE(refusal([&] { s.change("control.stiffness.hpi", 1); }).find("control.stiffness.hip"),
            std::string::npos);
  for (const double value : {-1.0, 2e6, std::nan("")})
    EXPECT_NE(refusal([&] { s.change("control.stiffness.hip", value); }).find("0 to 1e6 N m/rad"),
              std::string::npos);
  EXPECT_NE(refusal([&] { (void)s.read("/joint/hpi/angle"); }).find("/joint/hpi/angle"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::run::simulation_test
