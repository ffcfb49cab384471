// cli/identify_check.cpp - `sinew identify check`: what is wrong with measurements, before a static
// law is fitted to them.
#include <fmt/format.h>

#include "cli/identify.h"
#include "cli/json_text.h"
#include "cli/settings.h"
#include "sinew/identify/task/static_task.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  DataOptions data;
  identify::StaticSettings settings;
  std::string diameter;
  bool json = false;
};

Json json_of(const std::vector<identify::Check>& checks) {
  Json out{{"format", "sinew.check/1"}, {"red", identify::has_red(checks)}};
  out["checks"] = Json::array();
  for (const identify::Check& c : checks) {
    Json one{{"name", c.name}, {"light", identify::word(c.light)}, {"evidence", c.evidence}};
    if (!c.advice.empty()) one["advice"] = c.advice;
    out["checks"].push_back(one);
  }
  return out;
}

// Fails where a check is red, so that a script stops.
ExitCode run_check(const Options& options) {
  const std::vector<identify::Check> checks =
      identify::check_before_static(sources_of(options.data), options.settings, options.diameter);
  if (options.json) {
    fmt::print("{}\n", json_text(json_of(checks), 2));
  } else {
    for (const identify::Check& c : checks) {
      fmt::print("{:<6}  {:<17}  {}\n", identify::word(c.light), c.name, as_options(c.evidence));
      if (!c.advice.empty()) fmt::print("{:27}{}\n", "", as_options(c.advice));
    }
  }
  return identify::has_red(checks) ? failed : ok;
}

}  // namespace

void add_identify_check(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = identify.subcommand(
      "check", "are units, lengths and branches plausible, before `identify static`",
      "sinew identify check map.csv --map force=F_N,pressure=P_gauge_Pa,length=L_m --unit F_N=N "
      "--unit \"P_gauge_Pa=Pa gauge\" --unit L_m=m --rest-length \"250 mm\"");
  add_data_options(sub, options->data);
  add_length_options(sub, options->settings.rest_length, options->settings.lengths);
  sub.add_option("--diameter", options->diameter,
                 "of the muscle without pressure and load, to compare its force with");
  sub.add_flag("--json", options->json, "print the checks as JSON");
  sub.callback([options, &action] { action = [options] { return run_check(*options); }; });
}

}  // namespace sinew::cli
