// cli/check.cpp - `sinew check`: everything that is wrong with files, without running anything.
#include <fmt/format.h>

#include "cli/command.h"
#include "sinew/files/check.h"
#include "sinew/json/json.h"

namespace sinew::cli {

namespace {

using files::Finding;

struct CheckOptions {
  std::vector<std::string> files;
  bool json = false;
};

ExitCode check_all(const CheckOptions& options) {
  bool good = true;
  Json report = Json::array();
  for (const std::string& file : options.files) {
    const Finding finding = files::check(file);
    good = good && finding.problems.empty();
    report.push_back(
        {{"file", finding.file}, {"problems", finding.problems}, {"warnings", finding.warnings}});
    if (!finding.faults.empty()) report.back()["faults"] = finding.faults;
    for (const files::Unsourced& one : finding.unsourced)
      report.back()["unsourced"].push_back(
          {{"key", one.key}, {"value", one.value}, {"file", one.file}, {"line", one.line}});
    if (!options.json) fmt::print("{}", files::text_of(finding));
  }
  if (options.json) fmt::print("{}\n", report.text(2));
  return good ? ok : failed;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App& sub = subcommand(app, "check", "what is wrong with files, all of it at once",
                             "sinew check robots/leg/*.toml robots/leg/predict.dat");
  sub.add_option(
         "FILE", options->files,
         "experiment, rig, plan, tuning, robot, actuator, valves, wiring file, predict.dat, "
         "gain*.dat, or a "
         "run's folder or log")
      ->required();
  sub.add_flag("--json", options->json, "as JSON");
  sub.callback([=, &action] { action = [=] { return check_all(*options); }; });
}

}  // namespace sinew::cli
