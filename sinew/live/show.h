// live/show.h - a run while it goes, for pages: their first text, what they are sent, and what they
// may ask. All of it belongs to one thread, the watchers'; the loop knows only feed and steering.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/live/request.h"
#include "sinew/log/writer.h"
#include "sinew/report/page/changes.h"
#include "sinew/report/page/growing.h"
#include "sinew/run/controllers/steering.h"
#include "sinew/signals/table.h"

namespace sinew::live {

// Holds the records of a run for its watchers: the loop pushes, a thread of the watchers collects.
//
// The loop never waits: where the watchers are behind by a whole ring, what comes is left out, and
// with it the rest of its row. The log lacks nothing.
class Feed {
 public:
  // `topics` in the recorder's order: /valve/… are edges, the others the fields of a row. `ring`:
  // samples between the two threads.
  explicit Feed(std::vector<signals::Topic> topics, std::size_t ring = 1 << 16);

  // --- the loop's side ---

  // One sample of the topic with this place in the list. No heap, no lock.
  void push(std::size_t topic, std::int64_t time_ns, std::span<const double> values) noexcept;

  // --- the watchers' side ---

  // Returns what is recorded, in the order of its numbers.
  std::vector<signals::Topic> topics() const;

  // Takes in what has come: whole rows, and edges.
  void collect();

  // How far a watcher has got.
  struct Position {
    std::size_t rows = 0;
    std::vector<std::size_t> edges;  // of each of those topics
  };
  std::size_t rows() const { return rows_; }
  // What was taken in since; `position` is then where it ends.
  signals::Table since(Position& position) const;

  // How many samples came too fast to be taken in.
  std::uint64_t left_out() const noexcept { return left_out_.load(std::memory_order_relaxed); }

 private:
  void take(const log::Sample& sample);
  void keep_row();

  const signals::PageFile pages_ = signals::PageFile::make();
  signals::Table table_;
  std::vector<std::size_t> row_topics_, edge_topics_;
  std::vector<bool> is_edge_;
  signals::Ring<log::Sample> ring_;
  std::atomic<std::uint64_t> left_out_{0};

  // The row that is coming in.
  std::vector<log::Sample> row_;  // by topic
  std::int64_t row_time_ns_ = -1;
  std::size_t filled_ = 0, rows_ = 0;
};

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
