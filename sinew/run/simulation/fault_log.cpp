#include "sinew/run/simulation/fault_log.h"

#include <fmt/format.h>

#include <iterator>

#include "sinew/control/link/texts.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/remote_boards.h"

namespace sinew::run {
namespace {

const char* name(control::BoardState state) {
  constexpr const char* names[] = {"fault", "idle", "armed", "running", "hold", "vent", "dump"};
  return names[static_cast<std::size_t>(state)];
}

std::string head(const control::Board& board, const robot::Robot& robot) {
  std::string out = "time_s,state,why,frames";
  for (const std::uint8_t sensor : board.channel) {
    const std::string& name = robot.sensors[sensor].name;
    out += fmt::format(",{0}.reading,{0}.counts,{0}.rejected", name);
  }
  for (const std::uint8_t joint : board.joint) {
    const std::string name =
        joint < robot.joints.size() ? robot.joints[joint].name : std::string("cylinder");
    for (const char* field : {"velocity", "stiffness_output", "angle_output", "flexor_inlet",
                              "flexor_exhaust", "extensor_inlet", "extensor_exhaust"})
      out += fmt::format(",{}.{}", name, field);
  }
  return out + "\n";
}

std::string line(const link::Telemetry& t, const control::Board& board) {
  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{:.4f},{},\"{}\",{}", signals::tick_seconds * static_cast<double>(t.tick),
                 name(t.state), link::to_text(t.fault), t.link.line.frames);
  for (std::size_t c = 0; c < board.channel.size(); ++c) {
    const control::SensorStatistics& sensor = t.supervised.sensor[c];
    fmt::format_to(to, ",{},{},{}", t.controller.reading[c].counts, sensor.counts, sensor.rejected);
  }
  for (std::size_t j = 0; j < board.joint.size(); ++j) {
    const control::JointState& joint = t.controller.joint[j];
    const control::Duties& d = joint.duties;
    fmt::format_to(to, ",{},{},{},{},{},{},{}", joint.velocity, joint.stiffness_output,
                   joint.angle_output, d.flexor_inlet, d.flexor_exhaust, d.extensor_inlet,
                   d.extensor_exhaust);
  }
  return out + "\n";
}

}  // namespace

std::string fault_log_csv(std::span<const link::Telemetry> log, const experiment::Experiment& e) {
  const control::Board board = only_board(e);
  std::string out = head(board, named_parts(e));
  for (const link::Telemetry& t : log) out += line(t, board);
  return out;
}

}  // namespace sinew::run
