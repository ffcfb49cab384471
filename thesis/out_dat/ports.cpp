#include "thesis/out_dat/ports.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::thesis {

std::string write_ports(const signals::Table& table, const experiment::Experiment& e) {
  const auto bits = robot::bits_of(e.robot, e.wiring);
  int boards = 1, highest = 15;
  for (const robot::ValveBit& b : bits)
    boards = std::max(boards, b.board), highest = std::max(highest, b.bit);
  const auto ports = static_cast<std::size_t>(highest / 8 + 1);

  std::string out = boards > 1 ? "time [s],board [1]" : "time [s]";
  for (std::size_t p = 0; p < ports; ++p) out += fmt::format(",port {} [1]", p);
  out += "\n";
  for (int board = 1; board <= boards; ++board) {
    auto its = bits;
    std::erase_if(its, [&](const robot::ValveBit& b) { return b.board != board; });
    for (const robot::PortBytes& b : robot::port_bytes(table, its, e.wiring.polarity)) {
      out += fmt::format("{:.4f}", 1e-9 * static_cast<double>(b.time_ns));
      if (boards > 1) out += fmt::format(",{}", board);
      for (std::size_t p = 0; p < ports; ++p) out += fmt::format(",{}", b.port[p]);
      out += "\n";
    }
  }
  return out;
}

}  // namespace sinew::thesis
