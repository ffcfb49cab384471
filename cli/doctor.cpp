// cli/doctor.cpp - `sinew doctor`: is this computer ready to drive a machine, and what to do.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/host/doctor.h"
#include "sinew/host/realtime.h"
#include "sinew/json/json.h"

namespace sinew::cli {

namespace {

using host::Verdict;

struct DoctorOptions {
  std::string place = "simulated";
  bool json = false;
};

std::string_view word(Verdict v) {
  if (v == Verdict::good) return "good";
  return v == Verdict::advice ? "advice" : "missing";
}

void print(const std::vector<host::Finding>& findings) {
  for (const host::Finding& f : findings) {
    const std::string verdict = fmt::format("{:<8}", word(f.verdict));
    fmt::print("{}{}: {}\n", f.verdict == Verdict::missing ? in_red(verdict) : verdict, f.subject,
               f.found);
    if (f.verdict == Verdict::good) continue;
    fmt::print("        {}{}\n", f.why, f.place.empty() ? "" : fmt::format(" ({}:)", f.place));
    if (!f.todo.empty()) fmt::print("        {}\n", f.todo);
  }
}

void print_json(const std::vector<host::Finding>& findings, const DoctorOptions& options,
                bool ready) {
  Json list = Json::array();
  for (const host::Finding& f : findings) {
    Json item{
        {"subject", f.subject}, {"verdict", word(f.verdict)}, {"found", f.found}, {"why", f.why}};
    if (!f.place.empty()) item["place"] = f.place;
    if (!f.todo.empty()) item["todo"] = f.todo;
    list.push_back(std::move(item));
  }
  const Json all{{"format", "sinew.doctor/1"},
                 {"place", options.place},
                 {"ready", ready},
                 {"findings", std::move(list)}};
  fmt::print("{}\n", all.text(2));
}

// As the loop itself would run.
host::Latency measure() {
  const host::RealTime real_time;
  return host::measure_latency(1);
}

ExitCode examine(const DoctorOptions& options) {
  const std::vector<host::Finding> findings = host::examine({.latency = measure});
  const bool ready = host::is_ready(findings, options.place);
  if (options.json)
    print_json(findings, options, ready);
  else
    print(findings);
  if (!ready)
    error(fmt::format("{}: something that it needs is missing; what to do stands with it",
                      options.place));
  return ready ? ok : failed;
}

}  // namespace

void add_doctor(CLI::App& app, Action& action) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App& sub = subcommand(app, "doctor", "is this computer ready to drive a machine?",
                             "sinew doctor --for comedi");
  sub.add_option("--for", options->place,
                 "exit 1 where what such a place needs is missing: simulated, serial, emulated, "
                 "comedi")
      ->check(one_of({"simulated", "serial", "emulated", "comedi"}))
      ->capture_default_str();
  sub.add_flag("--json", options->json, "print the findings as JSON");
  sub.callback([=, &action] { action = [=] { return examine(*options); }; });
}

}  // namespace sinew::cli
