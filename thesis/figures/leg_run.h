// thesis/figures/leg_run.h - a run of the leg in memory, and its curves in the thesis's units: what
// chapters 6 and 7 plot.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/summary.h"
#include "sinew/report/page/channels.h"
#include "sinew/units/shown.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {

// Stretch of a run that is drawn  [s]; its times count from the first phase on.
struct Window {
  double from = 0, to = 0;
};

class LegRun {
 public:
  // Runs experiments/<name>.toml. Throws config::Error where it cannot be read.
  LegRun(const Sources& from, const std::string& name);
  LegRun(const LegRun&) = delete;
  LegRun& operator=(const LegRun&) = delete;

  // Returns the machine that went, and what it recorded.
  const analysis::Machine& machine() const { return analysis_.machine; }
  const analysis::Record& record() const { return analysis_.record; }
  double summary(std::string_view key) const;          // NaN: no such key
  std::string caption(const std::string& what) const;  // says of which run it is

  Window sequence() const;                    // from the first phase to the last one's end
  Window phase(std::string_view name) const;  // the first time that it goes
  std::vector<report::Span> stance() const;   // each time that the foot stood, by the plan

  // Over time; `sign` turns what is drawn downwards.
  report::Curve curve(const std::string& label, const report::Channel& channel,
                      const Window& window, int color, double sign = 1) const;
  report::Curve desired(const std::string& label, const report::Channel& channel,
                        const Window& window, int color) const;
  // y over x of a topic with both.
  report::Curve path(const std::string& label, const std::string& topic,
                     const Window& window) const;

  // Values of a topic at the record's rows, in the thesis's units.
  analysis::Column rows(const report::Channel& channel) const;

  // The experiment's own verdicts on keys that begin with one of these.
  std::vector<report::Claim> verdicts(const std::vector<std::string>& keys) const;

 private:
  report::Channels channels() const;
  units::ShownUnit unit_of(const report::Channel& channel) const;
  bool within(const Window& window, std::int64_t time_ns) const;

  std::string file_;
  signals::Table table_;
  analysis::Analysis analysis_;
  double start_ = 0;  // of the first phase [s]
};

// Over the phases, with stance shaded.
report::Plot over_time(const LegRun& run, const std::string& quantity, const std::string& unit,
                       std::vector<report::Curve> curves);

// /joint/<j>`what` of hip and knee, and what was desired of it.
std::vector<report::Curve> of_joints(const LegRun& run, const std::string& what, bool desired);

// Desired and actual angles of hip and knee; desired and actual path of the foot, of measured
// angles.
report::Figure joint_angles(const LegRun& run, const std::string& number, const std::string& title);
report::Figure foot_path(const LegRun& run, const std::string& number, const std::string& title,
                         const std::string& caption, const Window& window);

}  // namespace sinew::thesis
