// report/figures/run_maker.h - what the figures of one run have in common: its samples in shown
// units, what is shaded, and what captions say of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/report/figures/run_figures.h"
#include "sinew/report/page/channels.h"
#include "sinew/report/page/panels.h"

namespace sinew::report {

// Holds what captions and curves say of a run.
struct RunWords {
  std::string run;     // "Walking, test 1" (walk-test-1)
  std::string source;  // of every curve: "simulated, robot …, seed 1, sinew 0.1.0"
  Curve::Kind kind = Curve::Kind::computed;
};

// `title` and `robot` are of what was run; either may be empty.
RunWords words_of(const Run& run, const std::string& title, const std::string& robot);

// Makes the figures of one run out of its channels.
class Maker {
 public:
  // `channels` outlive this. `atmosphere`: what gauges count from  [Pa].
  Maker(const Channels& channels, RunWords about, const RunFigureOptions& options,
        double atmosphere)
      : channels_(channels), about_(std::move(about)), options_(options), atmosphere_(atmosphere) {}

  // Shades where the foot stands.
  void shade(std::vector<Span> stance) { stance_ = std::move(stance); }
  // The faults that the run had, up to its end  [s].
  void shade(const std::vector<analysis::MachineFault>& faults, double end);
  // Adds the figure of a panel, without the lines that wait to be asked for.
  void panel(const Panel& panel);
  // Lines of one unit as plots of that name, as many as the colors ask for; none of no samples.
  std::vector<Plot> plots(const Panel& panel) const;
  // Returns what all captions of the run end with: stance, faults, and how the lines are defined.
  std::string notes(const Panel& panel) const;
  // Adds it, by a name of its own, unless there is nothing in it.
  void finish(Figure figure);
  // y over x, at the times of x; `desired` may have none.
  void over(const std::string& name, const std::string& title, const Axis& x, const Axis& y,
            std::vector<Curve> curves, bool equal_scale, const std::string& caption);
  Curve pair(const std::string& label, const Channel& x, const Channel& y,
             const units::ShownUnit& x_unit, const units::ShownUnit& y_unit,
             Curve::Kind kind) const;
  // For numbers of that size  [SI].
  units::ShownUnit unit(std::string_view of, double largest) const {
    return options_.units.of(of, largest, atmosphere_);
  }
  double largest(const Channel& channel) const;
  Curve::Kind kind() const { return about_.kind; }
  const RunWords& words() const { return about_; }

  std::vector<Figure> list;

 private:
  bool shown(double seconds) const { return seconds >= options_.from && seconds <= options_.to; }
  Curve curve(const Line& line, const units::ShownUnit& unit, bool steps) const;
  std::string description(const Channel& channel) const;
  std::string meanings(const Panel& panel) const;

  const Channels& channels_;
  const RunWords about_;
  const RunFigureOptions options_;
  const double atmosphere_;
  std::vector<Span> stance_, faults_;
  std::string broken_;  // those faults in words
};

// A time of a table  [s].
inline double seconds_of(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

// An axis of a quantity in that unit; one of plain numbers says so.
Axis axis_of(std::string name, const units::ShownUnit& unit);

// The greatest size of a number in it; 0 where there is none.
double size_of(const signals::Column& values);

// "Joint angles" within a sentence.
std::string in_sentence(std::string title);

}  // namespace sinew::report
