#include "sinew/identify/valve/edges.h"

#include <fmt/format.h>

#include "sinew/gas/delay.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

Edges edges_of(const Measured& data) {
  const std::vector<double>&t = data["time"], &command = data["command"];
  const double half = 0.5 * (largest(command) + smallest(command));
  Edges out;
  for (std::size_t i = 1; i < t.size(); ++i) {
    const bool before = command[i - 1] > half, now = command[i] > half;
    if (now != before) out.edges.push_back({0.5 * (t[i] + t[i - 1]), now});
  }
  if (out.edges.empty())
    throw Refusal(data.file + ": command",
                  fmt::format("{:g} throughout", command.empty() ? 0.0 : command.front()),
                  "a coil that is switched at least once", "a record from before the switch");
  out.sample = median(steps_of(t));
  if (command.front() > half) out.edges.insert(out.edges.begin(), {t.front() - 1e3, true});
  return out;
}

std::vector<Opening> delayed(const std::vector<Opening>& edges, double opening_delay,
                             double closing_delay) {
  gas::Valve valve;
  valve.opening_delay = opening_delay;
  valve.closing_delay = closing_delay;
  gas::Shutter shutter(valve);
  std::vector<Opening> out;
  const auto take_until = [&](double t) {
    while (shutter.next() <= t) {
      const double at = shutter.next();
      shutter.advance(at);
      out.push_back({at, shutter.fraction(at) > 0.5});
    }
  };
  for (const Opening& e : edges) {
    take_until(e.time - 2 * gas::Shutter::simultaneous);
    shutter.electrical(e.time, e.open);
  }
  take_until(edges.empty() ? 0 : edges.back().time + opening_delay + closing_delay + 1);
  return out;
}

}  // namespace sinew::identify
