// run/simulation/recorder.h - watches a run and fills the channel table.
//
// One sample of everything per period, right after the last law has run (or every log period, where
// that is shorter or longer), and each valve edge by itself. Memory is reserved before the run and
// does not depend on its duration: what is more than a page per column goes to a temporary file
// (signals/paged_vector.h). While it goes, recording is noexcept and allocates nothing. What is
// recorded can be passed on to a log as it comes (Tap). Looking never changes the run: the world is
// peeked.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/controllers/controllers.h"
#include "sinew/signals/table.h"
#include "sinew/world/machine.h"

namespace sinew::run {

// Where else a record goes, for instance log::Writer::push. noexcept, no heap.
struct Tap {
  void* object = nullptr;
  void (*push)(void* object, std::uint16_t topic, std::int64_t time_ns,
               std::span<const double> values) noexcept = nullptr;
};

class Recorder {
 public:
  // Reads controllers and machine, which outlive it, up to the tick `end`; the machine is nullptr
  // for a body that is not simulated.
  Recorder(const experiment::Experiment& experiment, const Controllers& controllers,
           plant::Machine* machine, signals::Tick end);

  // Hands each sample to somebody else too, with the topic that each series has there.
  void tap(Tap t, std::vector<std::uint16_t> topic_of_series) {
    tap_ = t;
    tapped_ = std::move(topic_of_series);
  }
  // Tells how far the run is.
  void progress(std::atomic<std::int64_t>* tick) { progress_ = tick; }

  // The loop's side.
  void command(signals::Tick t) noexcept;
  void edge(const signals::Edge& edge) noexcept;
  void sample(signals::Tick t) noexcept;
  signals::Tick next(signals::Tick) const noexcept { return next_; }

  // Returns what was recorded, as series. Once, after the run. The table is not complete where
  // there was no more room for it: problem() then says what to do.
  signals::Table take();
  std::string problem() const { return complete_ ? "" : pages_.problem(); }

 private:
  void put(std::span<const double> values) noexcept;

  const Controllers& controllers_;
  plant::Machine* machine_;
  plant::Truths truths_;  // of the last sample

  // Once there is no more room, nothing is kept any more; the tap still gets it.
  template <class Samples>
  void keep(Samples& samples, typename Samples::value_type value) noexcept {
    complete_ = complete_ && samples.try_push_back(value);
  }
  void leave_out_parts();

  struct Edges {  // of one valve
    signals::Times time_ns;
    signals::Column values;
  };

  std::vector<Column> columns_;
  std::vector<signals::Topic> topics_;   // of the columns, then of the valves
  std::size_t first_edge_ = 0;           // topic of the first valve
  signals::PageFile pages_;              // where a long run's samples go
  signals::Times row_time_ns_;           // of all numbers below
  std::vector<signals::Column> values_;  // each number of a row
  std::vector<Edges> edges_;             // by valve
  bool complete_ = true;

  std::size_t cursor_ = 0, number_ = 0;  // topic, and number of the row, that the next put() is of
  std::int64_t now_ns_ = 0;
  signals::Tick period_ = 100, next_ = 0;
  Tap tap_;
  std::vector<std::uint16_t> tapped_;  // topic in the log of each of ours, or none
  std::atomic<std::int64_t>* progress_ = nullptr;
};

inline constexpr std::uint16_t not_tapped = 0xffff;

}  // namespace sinew::run
