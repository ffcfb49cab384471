#include <algorithm>
#include <iterator>

#include "thesis/figures/thesis.h"

namespace sinew::thesis {

namespace {

constexpr Exhibits (*makers[])(const Sources&) = {
    chapter_1, chapter_2, valve_laws, trapped_air,      pulsed_valve,
    chapter_4, chapter_5, chapter_6,  chapter_6_limits, chapter_7};

}  // namespace

std::int64_t steps() { return std::ssize(makers); }

report::Gallery gallery(const Sources& from, std::atomic<std::int64_t>& done) {
  report::Gallery out{
      .title = "The figures of Colbrunn (2000)",
      .lead =
          "Every plot of the thesis that can be computed, numbered as there, with the statements "
          "of "
          "its text. Curves are computed by the thesis's laws or by our simulation. "
          "What was measured is lost: where a synthetic curve replaces it, it is our "
          "own stand's and is marked so. Each verdict is computed from the curves as they are "
          "drawn, or from the run's summary, within a band that follows from the wording. Its "
          "class shows what agreement is worth: only what is predicted tests the model. What was "
          "fitted (docs/calibration.md) shows that one leg can do all of it at once; agreement of "
          "what was put in, is true by construction or is the same equations twice shows only "
          "that nothing is broken (docs/evidence/evidence.md).",
      .prefix = "Figure "};
  for (const auto make : makers) {
    for (Exhibit& e : make(from)) out.exhibits.push_back(std::move(e));
    ++done;
  }
  const auto place = [](const Exhibit& e) {
    const std::size_t dash = e.figure.name.find('-');
    return std::pair(std::stoi(e.figure.name.substr(0, dash)),
                     std::stoi(e.figure.name.substr(dash + 1)));
  };
  std::ranges::stable_sort(out.exhibits, {}, place);
  return out;
}

}  // namespace sinew::thesis
