// run/simulation/recorder.h - recorder of a run, which fills the table of channels.
//
// It records one sample of all channels per period, right after the last law has run (or per log
// period, if that differs), and each valve edge separately. Memory is reserved before the run. If
// samples and edges may need more than 4 MB, those beyond a page per column are moved to a
// temporary file (signals/paged_vector.h), so that memory does not grow with the duration. During
// the run, recording is noexcept and allocates nothing. Records can also be passed to a log as they
// come (Tap). Recording never changes the run, since the state of the world is extrapolated in a
// copy.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/controllers/controllers.h"
#include "sinew/signals/table.h"
#include "sinew/world/machine.h"

namespace sinew::run {

// Additional receiver of the records, for instance log::Writer::push. noexcept, without allocation.
struct Tap {
  void* object = nullptr;
  void (*push)(void* object, std::uint16_t topic, std::int64_t time_ns,
               std::span<const double> values) noexcept = nullptr;
};

class Recorder {
 public:
  // Origin of the true values.
  enum class Truths { none, of_machine, given };

  // Records the controllers and the machine, which must outlive it, up to the tick `end`, in the
  // columns of the experiment (controllers/columns.h). `machine` is nullptr for a body that is not
  // simulated. Of the topics, only those of `wanted` are recorded if it is given; the table's
  // series of the others are empty.
  Recorder(const experiment::Experiment& experiment, std::span<const Column> columns,
           const Controllers& controllers, plant::Machine* machine, signals::Tick end,
           const signals::TopicNames* wanted = nullptr)
      : Recorder(experiment, columns, controllers, machine ? Truths::of_machine : Truths::none, end,
                 wanted) {
    machine_ = machine;
  }
  // Records samples whose true values are given.
  Recorder(const experiment::Experiment& experiment, std::span<const Column> columns,
           const Controllers& controllers, Truths truths, signals::Tick end,
           const signals::TopicNames* wanted);

  // Also passes each sample to a receiver, with the receiver's topic for each series.
  void tap(Tap t, std::vector<std::uint16_t> topic_of_series) {
    tap_ = t;
    tapped_ = std::move(topic_of_series);
  }
  // Publishes the tick that the run has reached.
  void progress(std::atomic<std::int64_t>* tick) { progress_ = tick; }

  // Called by the loop.
  void command(signals::Tick t) noexcept;
  void edge(const signals::Edge& edge) noexcept;
  void sample(signals::Tick t) noexcept;
  signals::Tick next(signals::Tick) const noexcept { return next_; }

  // Records a sample at t with these true values and with these setpoints of a leg in place of the
  // high level's.
  void sample(signals::Tick t, const plant::Truths& truths, const gait::Desired& desired) noexcept;

  // Return the recorded columns, whether edges are recorded, and the ticks from sample to sample.
  std::vector<Column> columns() const;
  bool records_edges() const noexcept;
  signals::Tick period() const noexcept { return period_; }

  // Returns the recorded series. To be called once, after the run. The table is incomplete if
  // storage was exhausted; problem() then describes the remedy.
  signals::Table take();
  std::string problem() const { return complete_ ? "" : pages_.problem(); }

 private:
  void put(std::size_t topic, std::span<const double> values) noexcept;
  bool begin_sample(signals::Tick t) noexcept;
  void put_sample(const Snapshot& now) noexcept;

  const Controllers& controllers_;
  plant::Machine* machine_ = nullptr;
  plant::Truths truths_;  // at the last sample

  // Stores a value. After storage is exhausted, nothing more is stored; the tap still receives it.
  template <class Samples>
  void keep(Samples& samples, typename Samples::value_type value) noexcept {
    complete_ = complete_ && samples.try_push_back(value);
  }
  void leave_out_parts();

  struct Recorded {  // a column and its topic
    Column column;
    std::size_t topic;
  };
  struct Edges {  // edges of one valve
    bool wanted = true;
    std::size_t left_out = 0;  // edges of a valve that is not wanted
    signals::Times time_ns;
    signals::Column values;
  };

  std::vector<Recorded> columns_;
  enum class Needs { nothing, motion, all } needs_ = Needs::nothing;  // true values to compute
  std::vector<signals::Topic> topics_;   // those of all columns, then those of the valves
  std::size_t first_edge_ = 0;           // topic of the first valve
  signals::PageFile pages_;              // storage for the samples of a long run
  signals::Times row_time_ns_;           // times of all numbers below
  std::vector<signals::Column> values_;  // one column per number of a row
  std::vector<Edges> edges_;             // one per valve
  std::size_t most_edges_ = 0;           // room for a valve's edges
  bool complete_ = true;

  std::size_t number_ = 0;  // in the row, of the next put()
  std::int64_t now_ns_ = 0;
  signals::Tick period_ = 100, next_ = 0;
  Tap tap_;
  std::vector<std::uint16_t> tapped_;  // topic in the log for each recorded topic, or not_tapped
  std::atomic<std::int64_t>* progress_ = nullptr;
};

inline constexpr std::uint16_t not_tapped = 0xffff;

}  // namespace sinew::run
