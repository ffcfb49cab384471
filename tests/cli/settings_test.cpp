// Messages about the library's settings name the options that set them.
#include "cli/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "sinew/config/diagnostics.h"
#include "sinew/design/methods.h"
#include "sinew/identify/task/methods.h"
#include "tests/cli/program.h"

namespace sinew::test::settings_test {
namespace {

using cli::as_options;

TEST(Settings, AreReportedAsOptions) {
  EXPECT_EQ(as_options("try another one, or force=true to replace it"),
            "try another one, or --force to replace it");
  EXPECT_EQ(as_options("try full_scale=\"10 V\", units.gage=V or drop_incomplete=true"),
            "try --full-scale \"10 V\", --unit gage=V or --drop-incomplete");
  EXPECT_EQ(as_options("try units.\"Druck 1=kPa gauge\" or \"Druck 1=kPa abs\""),
            "try --unit \"Druck 1=kPa gauge\" or \"Druck 1=kPa abs\"");
  EXPECT_EQ(as_options("try names.flexor_pressure=NAME (known=load)"),
            "try --map flexor_pressure=NAME (--known load)");
  EXPECT_EQ(as_options("try length=\"200 mm\""), "try --length \"200 mm\"");
  EXPECT_EQ(as_options("a unit of length; try length=mm"), "a unit of length; try length=mm");
  EXPECT_EQ(as_options("run/1: align=sequence: found a run without phases"),
            "run/1: --align sequence: found a run without phases");
}

// Those that have a range or choices. A text file may have a key of another's name, "actuator".
struct IsOption : config::RowVisitor<IsOption> {
  void row(const identify::Setting& row, const std::string&) const { expect(row); }
  void row(const identify::Setting& row, int) const { expect(row); }
  void row(const identify::Setting&, const auto&) const {}
  static void expect(const identify::Setting& row) {
    if (row.kind == Kind::text || row.kind == Kind::file) return;
    const std::string text = as_options(std::string(row.name) + ": found \"x\"");
    EXPECT_TRUE(text.starts_with("--")) << text;
  }
};

TEST(Settings, OfAMethodOfIdentificationAreItsOptions) {
  identify::for_each_method([](auto settings) {
    IsOption visitor;
    fields(visitor, settings);
  });
}

TEST(Settings, OfADesignAreItsOptions) {
  design::for_each_design([](auto settings) {
    IsOption visitor;
    fields(visitor, settings);
  });
}

TEST(Settings, BeginAProblemOrDoNot) {
  EXPECT_EQ(as_options("names: found \"froce\"; expected force\nunits: found \"x\"; expected y"),
            "--map: found \"froce\"; expected force\n--unit: found \"x\"; expected y");
  EXPECT_EQ(as_options("a.csv: names: found \"x\""), "a.csv: --map: found \"x\"");
  EXPECT_EQ(as_options("a.toml:3:1: where: found \"x\""), "a.toml:3:1: where: found \"x\"");
  EXPECT_EQ(as_options("the model: found none"), "the model: found none");
  EXPECT_EQ(as_options("mass: found \"-1 kg\"\nrest_length: found \"1 s\""),
            "--mass: found \"-1 kg\"\n--rest-length: found \"1 s\"");
  EXPECT_EQ(as_options("a.csv: pressure: found none"), "a.csv: pressure: found none")
      << "a column of that name";
}

TEST(Settings, AProblemIsAnOptionsOrAFiles) {
  const auto is_of_option = [](config::Location where, const char* key) {
    return cli::is_of_option(config::Error(config::Problem{std::move(where), key, "9", "1", ""}));
  };
  EXPECT_TRUE(is_of_option({"width", 0, 0}, ""));
  EXPECT_TRUE(is_of_option({"--set", 0, 0}, "joint.hip.damping"));
  EXPECT_FALSE(is_of_option({"rig.csv", 3, 1}, "part"));
  EXPECT_FALSE(is_of_option({"run/1", 0, 0}, "align=sequence")) << "the run lacks it";
  EXPECT_FALSE(cli::is_of_option(std::runtime_error("--width: found")));
}

TEST(Settings, WhatAUserWroteStays) {
  for (const char* text : {"found \"force=true\"; expected key=value", "at length = 3 in",
                           "length==3", "pulse_length=3", "a unit in other units. Try",
                           "/runs/port=3/1", "seed=1", "--length \"3 in\"", "", "=", "names."})
    EXPECT_EQ(as_options(text), text);
  EXPECT_EQ(as_options("a 5\" tube\nport=0"), "a 5\" tube\n--port 0")
      << "a quote ends with its line";
}

// Every option that a message of the library names is one of the program's.
TEST(Settings, TheOptionsExist) {
  const Workspace w;
  const auto help = [&](Words words) {
    words.emplace_back("--help");
    return w.sinew(words).out;
  };
  struct Case {
    Words command;
    std::string settings;
  };
  // Of errors that begin a line each.
  const auto subjects = [](std::initializer_list<const char*> names) {
    std::string out;
    for (const char* name : names)
      out += (out.empty() ? "" : "\n") + std::string(name) + ": found ";
    return out;
  };
  const Case cases[] = {
      {{"identify", "static"},
       "names.a=b units.a=b columns=a where=a drop_incomplete=true values.length=a "
       "offsets.length=a rest_length=a "
       "actuator=a "
       "hold_out=a model=a"},
      {{"identify", "static"}, subjects({"values", "rest_length", "fit_where", "branch", "name"})},
      {{"identify", "geometry"}, subjects({"thread_thickness", "trapezoids", "side"})},
      {{"identify", "dynamic"}, subjects({"mass", "count", "pressure", "atmosphere"})},
      {{"identify", "joint"},
       subjects({"load", "lever", "down", "limb", "limb_lever", "moment_arm", "flexor_length",
                 "extensor_length", "rest_angle", "flexion", "base", "hold_out"})},
      {{"identify", "valve"},
       subjects({"kind", "volume", "conductance", "port", "exponent", "temperature", "frequency",
                 "predict_dat"})},
      {{"identify", "sensor"}, subjects({"rest", "bits", "full_scale"})},
      {{"force-beam"},
       subjects({"length", "width", "height", "gages", "modulus", "yield", "poisson",
                 "concentration", "bridge", "gage_factor", "excitation", "gain", "sensitivity"})},
      {{"identify", "joint"},
       "load=a lever=a down=a flexion=a moment_arm=a flexor_length=a keep_force=true"},
      {{"identify", "valve"},
       "volume=a conductance=a per_volume=true port=a exponent=a frequency=a"},
      {{"identify", "sensor"}, "known=a sensors=a bits=a full_scale=a"},
      {{"identify", "dynamic"}, "pressure=a external_volume=a exponent=a"},
      {{"sweep"}, "largest=a where=a"},
      {{"compare"}, "align=a"},
      {{"run"}, "force=true"},
      {{"view"}, "port=a"},
      {{"replay"}, "machine=a"}};
  for (const Case& c : cases) {
    const std::string text = help(c.command), options = as_options(c.settings);
    std::size_t count = 0;
    for (std::size_t at = 0; (at = options.find("--", at)) != options.npos; at += 2, ++count) {
      const std::string option = options.substr(at, options.find_first_of(" :", at) - at);
      EXPECT_NE(text.find(option), text.npos) << c.command.back() << ": " << option;
    }
    const char between = c.settings.find('\n') != c.settings.npos ? '\n' : ' ';
    EXPECT_EQ(count, 1 + static_cast<std::size_t>(std::ranges::count(c.settings, between)));
  }
}

}  // namespace
}  // namespace sinew::test::settings_test
