// live/show.h - a run while it goes, for pages: their first text, what they are sent, and what they
// may ask. All of it belongs to one thread, the watchers'; the loop knows only feed and steering.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/live/feed.h"
#include "sinew/live/request.h"
#include "sinew/report/page/changes.h"
#include "sinew/report/page/growing.h"
#include "sinew/run/controllers/steering.h"

namespace sinew::live {

class Show {
 public:
  // Where a page has got; each has its own.
  struct Position {
    Feed::Position samples;
    std::size_t changes = 0;  // that it was told
  };

  // All of them outlive this; `resolved` is what runs. `stop`: where a page's button stops a
  // machine that keeps its own time; nullptr for a simulation, which can be paused. `units`: in
  // which the page begins (config/shown_units.h), as asked for now.
  Show(const experiment::Experiment& experiment, const config::Node& resolved,
       run::Steering& steering, Feed& feed, const std::atomic<std::int64_t>& tick,
       std::atomic<bool>* stop = nullptr, const std::string& units = "");

  // The page without samples. `server`: where it may connect to, "127.0.0.1:8080".
  std::string page(std::string_view server) const;

  // Sees what was set since, by a page or by the plan's own list. To be called at every tick of the
  // server: what is set is marked where it is seen, at most a few rows late; the page of the
  // finished run marks it where it took effect.
  void notice();

  // Returns what is new to a page: JSON with `piece` (report/page/growing.h) and `changes`
  // (report/page/changes.h), where there are any, and `state`. "" before the first row.
  std::string frame(Position& position);

  // Does what a page asks. JSON for it alone: {"error": …} where it was nothing to be done, else
  // "".
  std::string answer(std::string_view request);

 private:
  std::string state() const;
  std::string refusal(Request::Kind) const;
  std::string controls() const;

  const experiment::Experiment& experiment_;
  run::Steering& steering_;
  Feed& feed_;
  const std::atomic<std::int64_t>& tick_;
  std::atomic<bool>* stop_;
  std::vector<gait::Setting> settings_;
  report::Growing growing_;
  std::vector<std::optional<double>> set_;   // of each setting, where it is not the plan's own
  std::vector<report::PageChange> changes_;  // since the run began
};

// The largest value that the plan ever has for the setting  [its SI unit].
double largest(const gait::Plan& plan, const gait::Setting& setting);

}  // namespace sinew::live
