#include "cli/help_topics.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/terminal.h"
#include "cli/wrapped.h"
#include "sinew/config/diagnostics.h"
#include "sinew/files/key_text.h"
#include "sinew/units/dimension.h"
#include "sinew/units/shown.h"
#include "sinew/units/unit.h"

namespace sinew::cli {

namespace {

// --- units ---

std::vector<Row> units_that_are_read() {
  std::vector<Row> out;
  for (const units::DimensionName& of : units::dimension_names) {
    std::string names;
    for (const units::Unit& unit : units::known_units)
      if (unit.dimension == of.dimension && of.dimension != units::dimension::none)
        names += (names.empty() ? "" : ", ") + std::string(unit.name);
    if (!names.empty()) out.push_back({std::string(of.word), names});
  }
  return out;
}

// Quantities that the three sets show in units of different names.
std::vector<Row> units_that_are_shown() {
  using units::ShownUnits, units::UnitSet;
  const auto thesis = shown_entries(ShownUnits(UnitSet::thesis)),
             metric = shown_entries(ShownUnits(UnitSet::metric));
  std::vector<Row> out;
  for (const units::ShownEntry& si : shown_entries(ShownUnits(UnitSet::si))) {
    const auto name_in = [&](const std::vector<units::ShownEntry>& set) {
      const auto at = std::ranges::find(set, si.quantity, &units::ShownEntry::quantity);
      return at == set.end() ? std::string("-") : at->shown[at->usual].name;
    };
    const std::string a = si.shown[si.usual].name, b = name_in(thesis), c = name_in(metric);
    if (a == b && b == c) continue;
    out.push_back({std::string(si.quantity), fmt::format("{}; {}; {}", a, b, c)});
  }
  return out;
}

std::string about_units() {
  return wrapped(
             "A quantity is written with its unit, in files and behind options: \"3.15 in\", \"80 "
             "mm\", \"0.4 N m/rad\". A product has a blank between its units, a power its digit "
             "(in2), and there is one \"/\" at most.") +
         "\n" +
         wrapped(
             "A pressure also says what it counts from: \"60 psi gauge\" from the room's, \"500 "
             "kPa abs\" from none at all; a difference is \"2 bar diff\". lbf is force, lb is "
             "mass. % is a hundredth.") +
         "\nUnits that are read:\n" + table(units_that_are_read()) +
         "\nUnits in which numbers are shown, of the sets si; thesis; metric:\n" +
         table(units_that_are_shown()) + "\n" +
         wrapped(
             "SINEW_UNITS=metric in the environment chooses for a session, --units for one "
             "command. \"metric,pressure=kPa gauge\" is a set with a choice of one's own. Files "
             "of numbers for programs, JSON and CSV, stay in SI and say so.");
}

// --- files ---

std::string about_files() {
  return wrapped(
             "A file of Sinew is TOML and begins with its kind and version, format = "
             "\"sinew.robot/1\". Its values are quantities with their units, or tables that also "
             "say where a value comes from: { value = \"23.8 lb\", source = \"scale, 2026\" }.") +
         "\n" +
         wrapped(
             "base = \"other.toml\" takes all of another file and changes some of it. Unknown "
             "keys are errors, with the one that was likely meant.") +
         "\nKinds of files, and what stands at their top:\n" +
         files::overview_of_keys(width_of_output() ? width_of_output() : 100) +
         "\nFrom nothing to a walk:\n" +
         table({{"sinew list", "the files that come with Sinew, and those of this folder"},
                {"sinew new robot my-arm", "a robot of your own to begin with"},
                {"sinew check FILE", "all that is wrong with it"},
                {"sinew show FILE", "each value as it is used, and where it came from"}}) +
         "\n" +
         wrapped(
             "sinew run writes a folder: log.mcap with all channels, resolved.toml with every "
             "value that was used, summary.json with the numbers, report.html to look at.");
}

// --- channels ---

std::string about_channels() {
  return wrapped(
             "A run's log has a channel for each thing that was measured, commanded or known. "
             "--channels takes names, with * for any letters: '/joint/*/angle'.") +
         "\n" +
         table({{"/joint/NAME/angle",
                 "of a joint [rad], as its sensor reads it; beside it its "
                 "rate, torque and stiffness"},
                {"/muscle/NAME/tension",
                 "[N]; beside it pressure [Pa abs], length [m], mass of "
                 "air [kg], inlet_duty and exhaust_duty"},
                {"/valve/MUSCLE/inlet/open", "when a valve is told to open or shut; exhaust too"},
                {"/sensor/NAME/count", "what the converter gave"},
                {"/trolley/position", "[m] and velocity [m/s] of a robot that rolls"},
                {"/foot/position", "[m] and force [N], of the ground on the foot"},
                {"/desired/…", "what the controller wanted of these"},
                {"/true/…", "what only a simulation knows: a log of hardware lacks it"}}) +
         "\nThose of a run, with their units:\n" +
         table({{"sinew export RUN --csv", "all as one table; its first line names them"},
                {"sinew compare RUN RUN", "where two runs differ, channel by channel"},
                {"sinew analyze RUN", "the numbers that follow from them"}});
}

// --- keys ---

std::string about_keys() {
  return wrapped(
             "Every value of every file has one name, with dots between its tables: "
             "joint.hip.damping. It is the same in files, behind --set, in sweeps and in Python.") +
         "\n" +
         table({{"sinew keys damping", "keys by a word of their name or of their description"},
                {"sinew keys joint.hip.damping", "one key: its unit, range, default and meaning"},
                {"sinew keys --kind rig", "all keys of one kind of file"},
                {"sinew keys --schema robot", "a JSON schema, by which an editor completes them"},
                {"sinew show FILE joint.hip", "their values in a file"},
                {"sinew run FILE --set KEY=VALUE", "another value for this run"},
                {"sinew sweep FILE --vary KEY=A,B", "a run for each of several"}}) +
         "\n" +
         wrapped(
             "An element of a list has its number, from 0: fault[0].at. A shell completes "
             "keys behind --set once it has read what sinew completion prints.");
}

// --- what next ---

std::string about_next() {
  return wrapped("A first quarter of an hour:") +
         table(
             {{"sinew list", "robots and experiments that come with Sinew"},
              {"sinew run experiments/walk-test-1.toml",
               "one of them; open the report.html that "
               "it names"},
              {"sinew run … --set air.supply.pressure=\"80 psi gauge\"", "the same with less air"},
              {"sinew compare RUN RUN -o compare.html", "what that changed"}}) +
         "\n" + wrapped("A muscle of your own:") +
         table({{"sinew identify check forces.csv …",
                 "can they be a muscle's, and what do they tell"},
                {"sinew identify static forces.csv …",
                 "from a CSV of lengths, pressures and "
                 "forces to the file of a muscle"},
                {"sinew actuator FILE --length … --pressure …", "what it pulls"},
                {"sinew new robot my-arm --metric", "a robot to put it in"},
                {"sinew new experiment lift --of my-arm/robot.toml", "and what it is to do"},
                {"sinew run lift.toml", "moves it"}}) +
         "\n" + wrapped("Better values:") +
         table({{"sinew sensitivity FILE", "which values a result follows"},
                {"sinew new plan gains --of lift.toml", "a table of runs to make"},
                {"sinew tune STUDY.toml", "searches for the best ones"}});
}

struct Topic {
  std::string_view word;
  std::string (*text)();
};
constexpr Topic topics[] = {{"units", about_units},
                            {"files", about_files},
                            {"channels", about_channels},
                            {"keys", about_keys},
                            {"next", about_next}};

}  // namespace

std::vector<std::string> topics_of_help() {
  std::vector<std::string> out;
  for (const Topic& topic : topics) out.emplace_back(topic.word);
  out.emplace_back("tables");
  out.emplace_back("commands");
  return out;
}

std::string names_of_topics() {
  const std::vector<std::string> names = topics_of_help();
  return config::either({names.begin(), names.end()});
}

std::string topic(std::string_view word) {
  const auto* at = std::ranges::find(topics, word, &Topic::word);
  return at == std::end(topics) ? "" : at->text();
}

}  // namespace sinew::cli
