// live/live_view.h - pages of a run in progress: their initial text, updates and requests. All of
// this is used by the server's thread; the control loop uses only feed and steering.
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
#include "sinew/report/page/live_page.h"
#include "sinew/report/page/parameters.h"
#include "sinew/run/controllers/steering.h"
#include "sinew/signals/table.h"

namespace sinew::live {

// Samples of a run for its pages: the control loop pushes, the server's thread collects.
//
// The loop never waits: if the ring is full, samples are dropped, with the rest of their row. The
// log is not affected.
class Feed {
 public:
  // `topics` are in the recorder's order: /valve/… are edges, the others the fields of a row.
  // `ring` is the number of samples between the two threads.
  explicit Feed(std::vector<signals::Topic> topics, std::size_t ring = 1 << 16);

  // --- the loop's side ---

  // Pushes one sample of the topic with this index. It uses neither heap nor locks.
  void push(std::size_t topic, std::int64_t time_ns, std::span<const double> values) noexcept;

  // --- the server's side ---

  // Returns the topics, in the order of their indices.
  std::vector<signals::Topic> topics() const;

  // Collects the pushed samples: complete rows, and edges.
  void collect();

  // Number of samples that a page has received.
  struct Position {
    std::size_t rows = 0;
    std::vector<std::size_t> edges;  // for each topic of edges
  };
  std::size_t rows() const { return rows_; }
  // Returns the samples collected since `position`, and advances it to their end.
  signals::Table since(Position& position) const;

  // Returns the number of dropped samples.
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

  // The incomplete row.
  std::vector<log::Sample> row_;  // one per topic
  std::int64_t row_time_ns_ = -1;
  std::size_t filled_ = 0, rows_ = 0;
};

class LiveView {
 public:
  // Samples and changes that a page has received.
  struct Position {
    Feed::Position samples;
    std::size_t changes = 0;
  };

  // All arguments but `units` must outlive this. `resolved` is the experiment that runs. `stop` is
  // set by a page's button to stop a machine that keeps its own time; nullptr for a simulation, as
  // it can be paused. `units` are the initial units of the page (config/shown_units.h).
  LiveView(const experiment::Experiment& experiment, const config::Node& resolved,
           run::Steering& steering, Feed& feed, const std::atomic<std::int64_t>& tick,
           std::atomic<bool>* stop = nullptr, const std::string& units = "");

  // Returns the page without samples. `server` is the address that it may connect to,
  // "127.0.0.1:8080".
  std::string page(std::string_view server) const;

  // Records changes of settings since the last call, by a page or by the plan's list. It has to be
  // called at every tick of the server: a change is marked at the time of the call, at most a few
  // rows late; the page of the finished run marks it at the time of its effect.
  void record_changes();

  // Returns an update for a page: JSON with `piece` (report/page/live_page.h) and `changes`
  // (report/page/parameters.h), if there are any, and `state`. Returns "" before the first row.
  std::string frame(Position& position);

  // Handles a request of a page. Returns {"error": …} for this page if it fails, else "".
  std::string handle(std::string_view request);

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
  report::LivePage page_;
  std::vector<std::optional<double>> set_;   // one per setting; empty: the plan's value
  std::vector<report::PageChange> changes_;  // since the run began
};

// Returns the largest value of a setting in the plan  [its SI unit].
double largest(const gait::Plan& plan, const gait::Setting& setting);

}  // namespace sinew::live
