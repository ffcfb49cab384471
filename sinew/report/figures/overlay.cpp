#include "sinew/report/figures/overlay.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::report {
namespace {

constexpr std::size_t most_together = 4;  // curves of one plot, without desired ones

// A curve with the index of its run.
struct Entry {
  std::size_t run = 0;
  Curve curve;
};

// All curves of one plot.
struct Stack {
  Plot plot;  // without its curves
  std::vector<Entry> entries;
};

bool is_desired(const Curve& curve) { return curve.kind == Curve::Kind::desired; }

bool same_samples(const Curve& a, const Curve& b) { return a.xs == b.xs && a.ys == b.ys; }

// Returns whether values of the axis `from` can be shown on the axis `to`.
bool convertible(const Axis& from, const Axis& to) {
  return from.unit == to.unit || (from.scale > 0 && to.scale > 0 && from.name == to.name);
}

void convert(std::vector<double>& values, const Axis& from, const Axis& to) {
  if (from.unit == to.unit) return;
  for (double& value : values) value *= to.scale / from.scale;
}

// Returns the labels of the curves that are not desired ones, in the order of occurrence. A single
// curve has an empty label, because its axis is named.
std::vector<std::string> channels_of(const Stack& stack) {
  std::vector<std::string> out;
  for (const Entry& e : stack.entries)
    if (!is_desired(e.curve) && std::ranges::find(out, e.curve.label) == out.end())
      out.push_back(e.curve.label);
  return out;
}

class Overlay {
 public:
  Overlay(const std::vector<LabelledRun>& runs, const std::string& name) : runs_(runs) {
    figure.name = name;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const auto at = std::ranges::find(runs[r].figures, name, &Figure::name);
      if (at != runs[r].figures.end()) add(*at, r);
    }
    for (const Stack& stack : stacks_) finish(stack);
  }
  Figure figure;

 private:
  void add(const Figure& of, std::size_t run);
  Stack& stack_for(const Plot& plot, std::size_t place);
  void finish(const Stack& stack);
  Curve with_distinct_style(const Entry& e, const std::vector<std::string>& channels,
                            const Plot& before) const;
  Plot with(const Stack& stack, const std::vector<std::string>& channels) const;

  const std::vector<LabelledRun>& runs_;
  std::vector<Stack> stacks_;
};

void Overlay::add(const Figure& of, std::size_t run) {
  if (figure.title.empty()) {
    figure.title = of.title;
    figure.paper = of.paper;
  }
  figure.missing.insert(figure.missing.end(), of.missing.begin(), of.missing.end());
  figure.caption +=
      fmt::format("{}{}: {}", figure.caption.empty() ? "" : " ", runs_[run].label, of.caption);
  for (std::size_t p = 0; p < of.plots.size(); ++p) {
    const Plot& plot = of.plots[p];
    Stack& stack = stack_for(plot, p);
    for (const Curve& curve : plot.curves) {
      Entry entry{run, curve};
      convert(entry.curve.xs, plot.x, stack.plot.x);
      convert(entry.curve.ys, plot.y, stack.plot.y);
      stack.entries.push_back(std::move(entry));
    }
  }
}

// Returns the stack of the same plot in an earlier run, or a new one if the units cannot be
// converted.
Stack& Overlay::stack_for(const Plot& plot, std::size_t place) {
  if (place < stacks_.size() && convertible(plot.x, stacks_[place].plot.x) &&
      convertible(plot.y, stacks_[place].plot.y))
    return stacks_[place];
  Stack stack{plot, {}};
  stack.plot.curves.clear();
  stacks_.push_back(std::move(stack));
  return stacks_.back();
}

void Overlay::finish(const Stack& stack) {
  const std::vector<std::string> channels = channels_of(stack);
  std::size_t together = 0;
  for (const Entry& e : stack.entries) together += is_desired(e.curve) ? 0 : 1;
  if (channels.size() < 2 || together <= most_together) {
    figure.plots.push_back(with(stack, channels));
    return;
  }
  for (const std::string& channel : channels) {
    figure.plots.push_back(with(stack, {channel}));
    figure.plots.back().title = channel;
    figure.plots.back().name += "-" + file_name_of(channel);
  }
}

bool has(const std::vector<std::string>& list, const std::string& text) {
  return std::ranges::find(list, text) != list.end();
}

// Returns whether an earlier run has the same desired curve.
bool is_repeated(const Stack& stack, const Entry& candidate) {
  return std::ranges::any_of(stack.entries, [&](const Entry& e) {
    return e.run < candidate.run && is_desired(e.curve) && e.curve.label == candidate.curve.label &&
           same_samples(e.curve, candidate.curve);
  });
}

// Returns a curve with label, color and dash that distinguish it from other channels and runs.
Curve Overlay::with_distinct_style(const Entry& e, const std::vector<std::string>& channels,
                                   const Plot& before) const {
  Curve out = e.curve;
  const std::string& run = runs_[e.run].label;
  const bool alone = channels.size() == 1;
  if (!is_desired(out)) {
    if (out.color == Curve::next)
      out.color = static_cast<int>(std::ranges::find(channels, out.label) - channels.begin());
    out.label = alone || out.label.empty() ? run : fmt::format("{}, {}", out.label, run);
  } else {
    if (alone) out.label = "desired";
    if (std::ranges::find(before.curves, out.label, &Curve::label) != before.curves.end())
      out.label = fmt::format("{}, {}", out.label, run);
  }
  out.dash = static_cast<int>(e.run);
  if (alone) out.color = out.dash;
  return out;
}

// Returns a plot of these channels and their desired curves.
Plot Overlay::with(const Stack& stack, const std::vector<std::string>& channels) const {
  Plot plot = stack.plot;
  std::vector<int> colors;  // colors of these channels in the runs' own plots
  for (const Entry& e : stack.entries)
    if (!is_desired(e.curve) && has(channels, e.curve.label)) colors.push_back(e.curve.color);
  for (const Entry& e : stack.entries) {
    const bool belongs =
        is_desired(e.curve)
            ? std::ranges::find(colors, e.curve.color) != colors.end() && !is_repeated(stack, e)
            : has(channels, e.curve.label);
    if (belongs) plot.curves.push_back(with_distinct_style(e, channels, plot));
  }
  return plot;
}

}  // namespace

std::vector<Figure> overlaid(const std::vector<LabelledRun>& runs) {
  std::vector<Figure> out;
  for (const LabelledRun& run : runs)
    for (const Figure& figure : run.figures)
      if (std::ranges::find(out, figure.name, &Figure::name) == out.end())
        out.push_back(std::move(Overlay(runs, figure.name).figure));
  return out;
}

}  // namespace sinew::report
