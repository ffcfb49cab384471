// config/shown_units_test.cpp - precedence of the sources of shown units.
#include "sinew/config/shown_units.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace sinew::config::shown_units_test {
namespace {

namespace fs = std::filesystem;
using units::UnitSet;

// Creates a user's folder with or without settings; restores the environment.
class RequestedUnits : public testing::Test {
 protected:
  RequestedUnits() {
    folder_ = fs::path(testing::TempDir()) / "sinew-units-asked-of";
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "sinew");
    setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
    unsetenv(units_variable);
  }
  ~RequestedUnits() override {
    unsetenv("XDG_CONFIG_HOME");
    unsetenv(units_variable);
    fs::remove_all(folder_);
  }

  std::string file() const { return (folder_ / "sinew" / "settings.toml").string(); }
  void settings(const std::string& text) const {
    std::ofstream(file()) << "format = \"sinew.settings/1\"\n" << text;
  }
  static std::string shown(const UnitsRequest& request) {
    return units_to_show(request, UnitSet::thesis).units.text();
  }
  // Returns the faults as one text.
  static std::string wrong(const UnitsRequest& request) {
    try {
      units_to_show(request);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

  fs::path folder_;
};

Node run_in(const std::string& units) {
  return parse_text("[page]\nunits = \"" + units + "\"\n", "run.toml");
}

TEST_F(RequestedUnits, NobodyTheCallersAreShown) {
  EXPECT_EQ(shown({}), "thesis");
  EXPECT_FALSE(units_to_show({}, UnitSet::thesis).is_requested);
  setenv(units_variable, "", 1);
  EXPECT_FALSE(units_to_show({}).is_requested) << "an empty variable says nothing";
  EXPECT_FALSE(units_to_show({.now = " "}).is_requested);
}

TEST_F(RequestedUnits, TheStrongerOneWins) {
  settings("units = \"si,length=cm\"\n");
  EXPECT_EQ(shown({}), "si,length=cm");
  const Node run = run_in("metric");
  EXPECT_EQ(shown({.run = &run}), "metric");
  setenv(units_variable, "thesis,force=N", 1);
  EXPECT_EQ(shown({.run = &run}), "thesis,force=N");
  EXPECT_EQ(shown({.now = "si", .run = &run}), "si");
}

TEST_F(RequestedUnits, ChoicesAloneAreAddedToThoseOfAWeakerOne) {
  settings("units = \"metric,length=cm\"\n");
  setenv(units_variable, "pressure=kPa gauge", 1);
  EXPECT_EQ(shown({}), "metric,length=cm,pressure=kPa gauge");
  EXPECT_EQ(shown({.now = "length=m"}), "metric,length=m,pressure=kPa gauge");
}

TEST_F(RequestedUnits, AResolvedRunHasThemToo) {
  const Node run =
      parse_text("[page]\nunits = { value = \"metric\", source = \"here\" }\n", "r.toml");
  EXPECT_EQ(shown({.run = &run}), "metric");
  const Node silent =
      parse_text("[page]\nunits = { value = \"\", source = \"default\" }\n", "r.toml");
  EXPECT_EQ(shown({.run = &silent}), "thesis");
}

TEST_F(RequestedUnits, MessagesSayWhereAWrongWordStands) {
  EXPECT_EQ(wrong({.now = "mertic", .now_is = "--units"}),
            "--units: found \"mertic\"; expected si, thesis or metric, then QUANTITY=UNIT; try "
            "\"metric\"");
  const Node run = run_in("length=s");
  EXPECT_EQ(wrong({.run = &run}),
            "run.toml:2:1: page.units: found \"s\", which measures something else; expected a unit "
            "of length, as in or mm; try length=mm");
  settings("\nunits = \"imperial\"\n");
  EXPECT_TRUE(wrong({}).starts_with(file() + ":3:1: units: found \"imperial\"; expected"))
      << wrong({});
  settings("unit = \"metric\"\n");
  EXPECT_TRUE(wrong({}).starts_with(file() + ":2:1: unit: found an unknown key")) << wrong({});
  fs::remove(file());
  setenv(units_variable, "inch", 1);
  EXPECT_TRUE(wrong({}).starts_with("SINEW_UNITS: found \"inch\"; expected")) << wrong({});
}

TEST_F(RequestedUnits, SettingsStandWhereTheFreedesktopRulesPutThem) {
  EXPECT_EQ(user_settings_path(), file());
  setenv("XDG_CONFIG_HOME", "not/absolute", 1);
  const char* before = std::getenv("HOME");
  const std::string home = before ? before : "";
  setenv("HOME", folder_.c_str(), 1);
  EXPECT_EQ(user_settings_path(), (folder_ / ".config" / "sinew" / "settings.toml").string());
  unsetenv("HOME");
  EXPECT_EQ(user_settings_path(), "");
  EXPECT_FALSE(units_to_show({}).is_requested);
  if (before) setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace sinew::config::shown_units_test
