// Thirty wrong inputs, each detected by its check; correct ones without any red check.
#include "sinew/identify/check/check.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>

#include "sinew/config/diagnostics.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/test_muscle.h"
#include "tests/places.h"

namespace sinew::identify::check_test {
namespace {

constexpr double rest = test_rest_length, kpa = 1e3;

StaticSetting truth() { return test_muscle(); }

// A row in a user's units: mm, kPa, N.
struct Row {
  double length, pressure, force, rest_length;
  std::string branch;
};

// An input of the check: a table with its units.
struct Input {
  std::vector<Row> rows;
  std::string length = "mm", pressure = "kPa gauge", force = "N";
  bool with_rest = false, with_branch = true;
  double diameter = 0;        // [m]
  double known_rest = 0;      // [m]
  std::vector<Input> others;  // further files
};

// The rig: mounts of a muscle, filled and vented, with sensor noise.
Input rig(double scale = 1, unsigned seed = 1, double full = 250, double from = 50,
          std::vector<double> contractions = {0, 0.02, 0.05, 0.09, 0.14}) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const StaticScales scales{.rest_length = rest};
  Input out;
  for (const bool fill : {true, false})
    for (const double c : contractions)
      for (double p = from; p <= 651; p += 50) {
        StaticPoint at{.length = rest * (1 - c),
                       .pressure = kpa * (fill ? p - 8 : p + 8),
                       .rest_length = rest};
        const double force = std::max(0.0, predicted(truth(), scales, at));
        out.rows.push_back({full * (1 - c), p + 0.4 * normal(random),
                            scale * (force + 1.0 * normal(random)), full, fill ? "fill" : "vent"});
      }
  return out;
}

std::string text_of(const Input& in) {
  std::string out = fmt::format(
      "length [{}],pressure [{}],force [{}]{}{}\n", in.length, in.pressure, in.force,
      in.with_rest ? ",rest_length [" + in.length + "]" : "", in.with_branch ? ",branch" : "");
  for (const Row& r : in.rows) {
    out += fmt::format("{},{},{}", r.length, r.pressure, r.force);
    if (in.with_rest) out += fmt::format(",{}", r.rest_length);
    out += in.with_branch ? "," + r.branch + "\n" : "\n";
  }
  return out;
}

// Tables that the reader refuses become "readable", as with the command.
std::vector<Check> checked(const Input& in) {
  CheckInput asked{.diameter = in.diameter};
  try {
    const auto add = [&](const Input& one, const std::string& name) {
      Source source;
      source.path = name;
      asked.add_or_report({parse_measured(text_of(one), source, static_columns()),
                           {.rest_length = one.known_rest}});
    };
    add(in, "rig.csv");
    for (std::size_t i = 0; i < in.others.size(); ++i)
      add(in.others[i], fmt::format("rig{}.csv", i));
  } catch (const config::Error& error) {
    return {{"readable", TrafficLight::red, error.what(), ""}};
  }
  return check_static(asked);
}

std::string words(const std::vector<Check>& checks) {
  std::string out;
  for (const Check& c : checks)
    if (c.light != TrafficLight::green)
      out += fmt::format("{}: {}: {}\n", word(c.light), c.name, c.evidence);
  return out;
}

struct Broken {
  const char* what;
  const char* check;
  TrafficLight at_least;
  std::function<void(Input&)> make;
};

void each(Input& in, const std::function<void(Row&)>& change) {
  for (Row& r : in.rows) change(r);
}

const Broken broken[] = {
    {"kPa called psi", "pressure unit", TrafficLight::red,
     [](Input& i) { i.pressure = "psi gauge"; }},
    {"psi called kPa", "pressure unit", TrafficLight::yellow,
     [](Input& i) { each(i, [](Row& r) { r.pressure /= 6.894757; }); }},
    {"gauge called absolute", "pressure unit", TrafficLight::red,
     [](Input& i) { i.pressure = "kPa abs"; }},
    {"absolute called gauge", "gauge or absolute", TrafficLight::red,
     [](Input& i) {
       i = rig(1, 1, 250, 0);
       i.known_rest = rest;
       each(i, [](Row& r) { r.pressure += 101.3; });
     }},
    {"absolute called gauge, from 100 kPa on", "gauge or absolute", TrafficLight::yellow,
     [](Input& i) {
       i = rig(1, 1, 250, 100);
       i.known_rest = rest;
       each(i, [](Row& r) { r.pressure += 101.3; });
     }},
    {"a lowest pressure that decides nothing", "gauge or absolute", TrafficLight::grey,
     [](Input& i) { i = rig(1, 1, 250, 300); }},
    {"another muscle's rows in the same table", "one muscle", TrafficLight::yellow,
     [](Input& i) {
       const Input other = rig(0.8, 2);
       i.rows.insert(i.rows.end(), other.rows.begin(), other.rows.end());
     }},
    {"bar called kPa", "readable", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.pressure /= 100; }); }},
    {"Pa called kPa", "readable", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.pressure *= 1000; }); }},
    {"lbf called N, diameter known", "force unit", TrafficLight::red,
     [](Input& i) {
       each(i, [](Row& r) { r.force /= 4.448; });
       i.diameter = 0.01;
     }},
    {"N called lbf, diameter known", "force unit", TrafficLight::red,
     [](Input& i) {
       i.force = "lbf";
       i.diameter = 0.01;
     }},
    {"kilonewtons called newtons", "force unit", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.force /= 1000; }); }},
    {"counts with their offset", "zero of force", TrafficLight::red,
     [](Input& i) {
       i = rig(1, 1, 250, 0);
       i.known_rest = rest;
       each(i, [](Row& r) { r.force = std::round(2048 + 3 * r.force); });
     }},
    {"counts", "counts", TrafficLight::yellow,
     [](Input& i) { each(i, [](Row& r) { r.force = std::round(3 * r.force); }); }},
    {"another muscle's diameter", "force unit", TrafficLight::red,
     [](Input& i) { i.diameter = 0.04; }},
    {"a negative force", "readable", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.force = -r.force; }); }},
    {"a force with a sign per branch", "sign of force", TrafficLight::red,
     [](Input& i) {
       each(i, [](Row& r) {
         if (r.branch == "vent") r.force = -0.7 * r.force;
       });
     }},
    {"a zero that was not taken off", "zero of force", TrafficLight::yellow,
     [](Input& i) {
       i = rig(1, 1, 250, 0);
       i.known_rest = rest;
       each(i, [](Row& r) { r.force += 27; });
     }},
    {"another zero at each mount", "zero of force", TrafficLight::yellow,
     [](Input& i) {
       i = rig(1, 1, 250, 0);
       i.known_rest = rest;
       each(i, [](Row& r) { r.force += std::lround(r.length) % 20 < 10 ? 12 : -12; });
     }},
    {"mm called m", "readable", TrafficLight::red, [](Input& i) { i.length = "m"; }},
    {"mm called inch", "readable", TrafficLight::red, [](Input& i) { i.length = "in"; }},
    {"cm called mm", "length unit", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.length /= 10; }); }},
    {"inch called mm", "length unit", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.length /= 25.4; }); }},
    {"a rest length shorter than a mount", "rest length", TrafficLight::red,
     [](Input& i) { i.known_rest = 0.2; }},
    {"a rest length that is a little short", "rest length", TrafficLight::yellow,
     [](Input& i) { i.known_rest = 0.246; }},
    {"muscles of two lengths pooled", "contraction", TrafficLight::red,
     [](Input& i) {
       i.others = {rig(1, 2, 110)};
       i.others[0].known_rest = rest;
     }},
    {"two mounts exchanged", "mounts in order", TrafficLight::red,
     [](Input& i) {
       each(i, [](Row& r) {
         r.length = r.length == 245 ? 227.5 : r.length == 227.5 ? 245 : r.length;
       });
     }},
    {"another muscle at one mount", "mounts in order", TrafficLight::red,
     [](Input& i) {
       each(i, [](Row& r) {
         if (r.length == 245) r.force *= 0.4;
       });
     }},
    {"fill and vent exchanged", "branches", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.branch = r.branch == "fill" ? "vent" : "fill"; }); }},
    {"vent rows called fill", "branches", TrafficLight::yellow,
     [](Input& i) { each(i, [](Row& r) { r.branch = "fill"; }); }},
    {"only the way up", "both ways", TrafficLight::yellow,
     [](Input& i) { std::erase_if(i.rows, [](const Row& r) { return r.branch == "vent"; }); }},
    {"a clipped force", "clipped sensor", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.force = std::min(r.force, 250.0); }); }},
    {"one length", "lengths", TrafficLight::red,
     [](Input& i) { std::erase_if(i.rows, [](const Row& r) { return r.length < 250; }); }},
    {"two lengths", "lengths", TrafficLight::yellow,
     [](Input& i) { std::erase_if(i.rows, [](const Row& r) { return r.length < 240; }); }},
    {"two pressures", "pressures", TrafficLight::red,
     [](Input& i) {
       std::erase_if(i.rows, [](const Row& r) {
         return std::abs(r.pressure - 300) > 5 && std::abs(r.pressure - 600) > 5;
       });
     }},
    {"one pressure", "readable", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.pressure = 600; }); }},
    {"a constant force", "force unit", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { r.force = 0.06; }); }},
    {"a file given twice", "files differ", TrafficLight::red, [](Input& i) { i.others = {i}; }},
    {"length and pressure exchanged", "contraction", TrafficLight::red,
     [](Input& i) { each(i, [](Row& r) { std::swap(r.pressure, r.length); }); }},
};

TEST(Check, ThirtyBrokenInputsAreCaughtByName) {
  static_assert(std::size(broken) >= 30);
  for (const Broken& b : broken) {
    Input in = rig();
    in.known_rest = rest;
    b.make(in);
    const std::vector<Check> checks = checked(in);
    const auto at = std::ranges::find_if(
        checks, [&](const Check& c) { return c.name == b.check && c.light >= b.at_least; });
    EXPECT_NE(at, checks.end()) << b.what << " is not caught by " << b.check << "; it says\n"
                                << words(checks);
    for (const Check& c : checks) {
      EXPECT_FALSE(c.evidence.empty()) << c.name;
      EXPECT_TRUE(c.light == TrafficLight::green || c.name == "readable" || !c.advice.empty())
          << c.name;
    }
  }
}

TEST(Check, GoodRigsHaveNoRed) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Input in = rig(1, seed);
    in.known_rest = rest;
    in.diameter = 0.01;
    const std::vector<Check> checks = checked(in);
    // It begins at a pressure, so the cell's zero is unknown, and no reading is repeated.
    for (const Check& c : checks)
      EXPECT_EQ(c.light, c.name == "zero of force" || c.name == "one muscle" ? TrafficLight::grey
                                                                             : TrafficLight::green)
          << seed << ": " << c.name << ": " << c.evidence;
    const Input again = rig(1, seed + 10);
    in.rows.insert(in.rows.end(), again.rows.begin(), again.rows.end());
    const std::vector<Check> repeated = checked(in);
    EXPECT_EQ(std::ranges::find(repeated, "one muscle", &Check::name)->light, TrafficLight::green);
  }
  EXPECT_FALSE(has_red(checked(rig(1, 6, 250, 100))))
      << words(checked(rig(1, 6, 250, 100)));  // a table that begins at 100 kPa
  EXPECT_FALSE(has_red(checked(rig(1, 7, 250, 100, {0.05, 0.08, 0.11, 0.14}))));
}

// Forces in lbf that are labelled N look like those of a thinner muscle: the check cannot decide
// this, but reports the diameter for numbers in lbf, which equals the one of the forces in N.
TEST(Check, ReportsTheDiameterInCaseTheForcesAreLbf) {
  const auto evidence = [](double scale) {
    Input in = rig(scale);
    in.known_rest = rest;
    for (const Check& c : checked(in))
      if (c.name == "force unit") {
        EXPECT_EQ(c.light, TrafficLight::yellow);
        EXPECT_NE(c.advice.find("diameter"), std::string::npos) << c.advice;
        return c.evidence;
      }
    return std::string();
  };
  const std::string newtons = evidence(1), pounds = evidence(1 / 4.448222);
  const std::string diameter = newtons.substr(newtons.find("a braid of ") + 11, 4);
  EXPECT_NE(pounds.find("of " + diameter + " mm if the numbers are lbf"), std::string::npos)
      << diameter << " is not in " << pounds;
}

// Reads a shipped table.
std::vector<Check> checked_file(const std::string& path, Source source) {
  source.path = path;
  CheckInput asked;
  asked.add_or_report({read_measured(source, static_columns()), {}});
  return check_static(asked);
}

TEST(Check, TheShippedMapHasNoRed) {
  Source source;
  source.names = {{"force", "F_N"}, {"pressure", "P_gauge_Pa"}, {"length", "L_m"}};
  source.units = {{"F_N", "N"}, {"P_gauge_Pa", "Pa gauge"}, {"L_m", "m"}};
  const auto checks = checked_file(
      sinew::test::source_dir() + "/data/martens_boblan_2017/DMSP-10-250_force_map.csv", source);
  EXPECT_FALSE(has_red(checks)) << words(checks);
}

TEST(Check, MeasuredMusclesHaveNoRed) {
  const char* shared = std::getenv("SINEW_DATA_DIR");
  if (shared == nullptr || !std::filesystem::exists(std::string(shared) + "/psu_10mm"))
    GTEST_SKIP() << "SINEW_DATA_DIR/psu_10mm is not there";
  for (const auto& [folder, muscles] :
       {std::pair{"/psu_10mm", std::vector{"182", "281", "382"}},
        std::pair{"/psu_20mm", std::vector{"98.0", "225.0", "398.0"}}})
    for (const char* muscle : muscles) {
      Source source;
      source.names = {{"force", "F_mean_N"},
                      {"pressure", "p_mean_kPa"},
                      {"length", "l_mounted_mm"},
                      {"rest_length", "l_rest_mm"},
                      {"branch", "phase"}};
      source.units = {{"F_mean_N", "N"},
                      {"p_mean_kPa", "kPa gauge"},
                      {"l_mounted_mm", "mm"},
                      {"l_rest_mm", "mm"}};
      // Some bins of the 398 mm muscle's raw table are at 40 MPa.
      source.where = {{"l_rest_mm", muscle},
                      {"p_bin_kPa", "0,100,150,200,250,300,350,400,450,500,550,600"}};
      const auto checks =
          checked_file(std::string(shared) + folder + "/isometric_bins.csv", source);
      EXPECT_FALSE(has_red(checks)) << folder << " " << muscle << "\n" << words(checks);
    }
}

}  // namespace
}  // namespace sinew::identify::check_test
