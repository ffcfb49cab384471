// thesis/figures/leg_run.h - a run of the leg in memory, and its curves in the thesis's units, for
// the plots of chapters 6 and 7.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/summary.h"
#include "sinew/report/page/plot.h"
#include "sinew/units/shown.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {

// Time window of a run that is drawn [s]; times count from the first phase.
struct Window {
  double from = 0, to = 0;
};

class LegRun {
 public:
  // Runs experiments/<name>.toml. Throws config::Error if it cannot be read.
  LegRun(const Sources& from, const std::string& name);
  LegRun(const LegRun&) = delete;
  LegRun& operator=(const LegRun&) = delete;

  // Return the machine of the run, and its recording.
  const analysis::Machine& machine() const { return analysis_.machine; }
  const analysis::Record& record() const { return analysis_.record; }
  double summary(std::string_view key) const;          // NaN: no such key
  std::string caption(const std::string& what) const;  // names the run

  Window sequence() const;                    // first phase to end of the last
  Window phase(std::string_view name) const;  // first occurrence of the phase
  std::vector<report::Span> stance() const;   // stance phases by the plan

  // Returns a curve over time; `sign` = -1 mirrors values that are drawn downwards.
  report::Curve curve(const std::string& label, const report::Channel& channel,
                      const Window& window, int color, double sign = 1) const;
  report::Curve desired(const std::string& label, const report::Channel& channel,
                        const Window& window, int color) const;
  // Returns y over x of a topic that has both.
  report::Curve path(const std::string& label, const std::string& topic,
                     const Window& window) const;

  // Returns values of a topic at the record's rows, in the thesis's units.
  analysis::Column rows(const report::Channel& channel) const;

  // Returns the experiment's verdicts on keys that begin with one of these.
  std::vector<report::Claim> verdicts(const std::vector<std::string>& keys) const;

 private:
  report::Channels channels() const;
  units::ShownUnit unit_of(const report::Channel& channel) const;
  bool within(const Window& window, std::int64_t time_ns) const;

  std::string file_;
  signals::Table table_;
  analysis::Analysis analysis_;
  double start_ = 0;  // start of the first phase [s]
};

// Returns a plot over the phases, with stance shaded.
report::Plot over_time(const LegRun& run, const std::string& quantity, const std::string& unit,
                       std::vector<report::Curve> curves);

// Returns /joint/<j>`what` of hip and knee, with the desired values if requested.
std::vector<report::Curve> of_joints(const LegRun& run, const std::string& what, bool desired);

// Return desired and actual angles of hip and knee; and desired and actual path of the foot, from
// measured angles.
report::Figure joint_angles(const LegRun& run, const std::string& number, const std::string& title);
report::Figure foot_path(const LegRun& run, const std::string& number, const std::string& title,
                         const std::string& caption, const Window& window);

// Adds the statements of the text about test 1 that summaries do not cover to 6-3 to 6-11.
void add_text_of_test_1(const LegRun& run, const Sources& from, Exhibits& out);

// Returns the largest amplitude of a joint's half swings in the swing of a step (the first is 0)
// [deg]; 0 if it does not turn twice (analysis/measures/statistics.h).
double swing_amplitude(const LegRun& run, const std::string& joint, int step);

}  // namespace sinew::thesis
