#include "sinew/run/bring_up/progress.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "sinew/json/json.h"
#include "sinew/run/folder/files.h"

namespace sinew::run {

namespace {

constexpr const char* format = "sinew.bring_up/1";

config::Node count_of(double count, const Learned& l) {
  config::Node out = config::make_table("at_rest");
  out.put(config::make_text("value", fmt::format("{:.1f} count", count)));
  out.put(config::make_text(
      "uncertainty",
      fmt::format("{:.2f} count", std::max(0.5, 2 * l.noise / std::sqrt(l.readings)))));
  out.put(config::make_text(
      "source", fmt::format("sinew bring-up: mean of {} readings, empty and still", l.readings)));
  return out;
}

}  // namespace

Progress read_progress(const std::filesystem::path& file, const std::string& robot) {
  if (!std::filesystem::exists(file)) return {.robot = robot};
  Progress out;
  try {
    std::ifstream in(file);
    Json root;
    if (!Json::parse(in, root) || root.at("format") != format) throw std::runtime_error("format");
    out.robot = root.at("robot").string();
    out.board = root.at("board").string();
    if (root.contains("machine")) out.machine = root.at("machine").string();
    for (const auto& [name, said] : root.at("steps").items()) out.done[name] = said.strings();
    for (const auto& [name, l] : root.at("sensors").items())
      out.learned[name] = {l.at("at_rest_count").number(), l.at("noise_count").number(),
                           static_cast<int>(l.at("readings").integer())};
    if (const Json* joints = root.find("joints"))
      for (const auto& [name, s] : joints->items())
        out.strokes[name] = {s.at("lowest_count").number(), s.at("highest_count").number()};
  } catch (const std::exception&) {
    config::fail({file.string(), 0, 0}, "", "no bring-up of ours", std::string("format ") + format,
                 "another folder");
  }
  if (out.robot != robot)
    config::fail({file.string(), 0, 0}, "robot", out.robot, robot,
                 "another folder: this one has the steps of another robot");
  return out;
}

void write_progress(const Progress& p, const std::filesystem::path& file) {
  Json root{{"format", format},     {"robot", p.robot},        {"board", p.board},
            {"machine", p.machine}, {"steps", Json::object()}, {"sensors", Json::object()}};
  for (const auto& [name, said] : p.done) root["steps"][name] = said;
  for (const auto& [name, l] : p.learned)
    root["sensors"][name] = {
        {"at_rest_count", l.at_rest}, {"noise_count", l.noise}, {"readings", l.readings}};
  root["joints"] = Json::object();
  for (const auto& [name, s] : p.strokes)
    root["joints"][name] = {{"lowest_count", s.lowest}, {"highest_count", s.highest}};
  write_file(file, root.exact_text(2) + "\n");
}

std::string learned_robot(const Progress& p, const std::filesystem::path& base,
                          const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  config::Node root = config::make_table("");
  root.put(config::make_text("format", "sinew.robot/1"));
  root.put(config::make_text(
      "base",
      fs::weakly_canonical(base).lexically_relative(fs::weakly_canonical(folder)).string()));
  config::Node sensors = config::make_table("sensor");
  for (const auto& [name, l] : p.learned) {
    config::Node sensor = config::make_table(name);
    for (const char* side : {"real", "assumed"}) {
      config::Node group = config::make_table(side);
      group.put(count_of(l.at_rest, l));
      sensor.put(std::move(group));
    }
    sensors.put(std::move(sensor));
  }
  root.put(std::move(sensors));
  return config::to_toml(root);
}

}  // namespace sinew::run
