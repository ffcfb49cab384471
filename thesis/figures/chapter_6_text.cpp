// thesis/figures/chapter_6_text.cpp - further statements of 6.3 about the figures of test 1:
// times of events, and results of other runs.
#include <algorithm>
#include <cmath>

#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/statistics.h"
#include "thesis/figures/leg_run.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using analysis::Column, analysis::PhaseSpan;

// Returns each stretch of the phase, except in steps before `from_step`.
std::vector<PhaseSpan> stretches(const LegRun& run, std::string_view phase, int from_step = 0) {
  std::vector<PhaseSpan> out;
  for (const PhaseSpan& s : run.record().phase_spans())
    if (run.machine().phases[static_cast<std::size_t>(s.phase)] == phase && s.step >= from_step)
      out.push_back(s);
  return out;
}

template <class Of>
double mean_of(const std::vector<PhaseSpan>& list, Of of) {
  double sum = 0;
  for (const PhaseSpan& s : list) sum += of(s);
  return sum / static_cast<double>(list.size());
}

// Returns the number of rows after which y stays above the level.
std::size_t passes(const Column& y, const PhaseSpan& s, double level) {
  std::size_t at = s.first;
  for (std::size_t i = s.first; i < s.last; ++i)
    if (y[i] < level) at = i + 1;
  return at;
}

// Returns the delay of the hip at 280 deg on its way forward, as a share of swing [%].
double lag(const LegRun& run) {
  const Column is = run.rows({"/joint/hip/angle"}), wanted = run.rows({"/desired/joint/hip/angle"});
  return mean_of(stretches(run, "swing", 1), [&](const PhaseSpan& s) {
    const auto late =
        static_cast<double>(passes(is, s, 280)) - static_cast<double>(passes(wanted, s, 280));
    return 100 * late / static_cast<double>(s.last - s.first);
  });
}

// Returns the share of propulsion before the hip has moved by half a degree.
double standing_share(const LegRun& run) {
  const Column angle = run.rows({"/joint/hip/angle"});
  return mean_of(stretches(run, "propulsion"), [&](const PhaseSpan& s) {
    std::size_t at = s.first;
    while (at < s.last && std::fabs(angle[at] - angle[s.first]) < 0.5) ++at;
    return static_cast<double>(at - s.first) / static_cast<double>(s.last - s.first);
  });
}

// Returns the change of a torque over the second half of swing, by the straight line through it;
// the smallest of the steps, as a share of its range over the walk [%].
double change_of(const LegRun& run, const std::string& topic) {
  const Column torque = run.rows({topic});
  const Column& walk = run.record().sequence();
  double least = 1e300;
  for (const PhaseSpan& s : stretches(run, "swing")) {
    std::vector<double> time, part;
    for (std::size_t i = (s.first + s.last) / 2; i < s.last; ++i) {
      time.push_back(run.record().time(i));
      part.push_back(torque[i]);
    }
    least = std::min(least, report::line_of({time, part}).slope * (time.back() - time.front()));
  }
  return 100 * least / (analysis::largest(torque, walk) - analysis::smallest(torque, walk));
}

// Returns the drop of the normal force from its height at touch-down within the first half of
// stance, as a share of its maximum [%].
double spike(const LegRun& run) {
  const Column force = run.rows({"/foot/force", "y"});
  const double largest = analysis::largest(force, run.record().stance());
  return 100 / largest * mean_of(stretches(run, "propulsion"), [&](const PhaseSpan& s) {
           double top = force[s.first], fall = 0;
           for (std::size_t i = s.first; i < (s.first + s.last) / 2; ++i) {
             top = std::max(top, force[i]);
             fall = std::max(fall, top - force[i]);
           }
           return fall;
         });
}

// Returns the share of propulsion in which a muscle is nearly empty [%].
double empty_for(const LegRun& run, const std::string& muscle) {
  Column low;
  for (const double p : run.rows({"/true/muscle/" + muscle + "/pressure"}))
    low.push_back(p < 5 ? 100 : 0);
  const int propulsion = analysis::find_phase(run.machine(), "propulsion");
  return analysis::mean(low, run.record().part(propulsion, 0, 1));
}

// Turning points of the hip's error in a swing, and their amplitudes [deg].
struct SwingTurns {
  std::vector<analysis::TurningPoint> points;  // rows count from the swing's first
  double rows = 0;
};

SwingTurns turns_in(const LegRun& run, const std::string& joint, const PhaseSpan& s) {
  const Column error = run.rows({"/joint/" + joint + "/error"});
  const double back = analysis::least_return * 180 / M_PI;
  return {analysis::turning_points(error.slice(s.first, s.last), back),
          static_cast<double>(s.last - s.first)};
}

// Returns the share of swing after which the hip does not turn, mean over the steps [%].
double last_turn(const LegRun& run) {
  return mean_of(stretches(run, "swing"), [&](const PhaseSpan& s) {
    const SwingTurns t = turns_in(run, "hip", s);
    return t.points.empty() ? 0 : 100 * static_cast<double>(t.points.back().row) / t.rows;
  });
}

// Returns the largest duty from the first propulsion on: before, empty muscles are filled with the
// full flow of the valves.
double largest_duty(const LegRun& run, const std::string& valve) {
  Column walking = run.record().sequence();
  const std::size_t first = stretches(run, "propulsion").at(0).first;
  for (std::size_t i = 0; i < first; ++i) walking.set(i, 0.0);
  return analysis::largest(run.rows({"/muscle/" + valve + "_duty"}), walking);
}

}  // namespace

double swing_amplitude(const LegRun& run, const std::string& joint, int step) {
  double largest = 0;
  for (const PhaseSpan& s : stretches(run, "swing", step))
    if (s.step == step)
      for (const double a : analysis::amplitudes(turns_in(run, joint, s).points))
        largest = std::max(largest, a);
  return largest;
}

namespace {

// Returns the largest half swing of a joint's error in any swing, as a share of its excursion [%].
double largest_swing(const LegRun& run, const std::string& joint) {
  double largest = 0;
  for (int step = 0; step < static_cast<int>(run.summary("steps")); ++step)
    largest = std::max(largest, swing_amplitude(run, joint, step));
  return 100 * largest / (run.summary("joints." + joint + ".excursion_rad") * 180 / M_PI);
}

}  // namespace

void add_text_of_test_1(const LegRun& run, const Sources& from, Exhibits& out) {
  const Section text("6.3");
  const auto add = [&](const char* figure, report::Claim claim) {
    std::ranges::find_if(out, [&](const Exhibit& e) {
      return e.figure.name == figure;
    })->claims.push_back(std::move(claim));
  };
  // Adds a statement that is judged in another experiment's file, with the wording of the text.
  const auto add_run = [&](const char* figure, const char* experiment, const char* key,
                           const char* says) {
    for (report::Claim& c : LegRun(from, experiment).verdicts({key})) {
      c.says = says;
      c.quantity = std::string("experiments/") + experiment + ".toml, " + c.quantity;
      add(figure, std::move(c));
    }
  };
  add_run("6-3", "zero-gap", "trolley.distance_m", "With no gap to the table the leg goes nowhere");
  add_run("6-3", "zero-gap", "foot.slip", "With no gap the foot slides across the table");
  add("6-4", text.number(predicted, "The angles follow late, as proportional control does",
                         "slight", "how much later the hip passes 280 deg, as a share of swing",
                         lag(run), "%", analysis::small(100),
                         "mostly the exhausts' dead time: below 7 % nothing passes them, which is "
                         "15 deg at the hip's gain"));
  const double excursion = run.summary("joints.hip.excursion_rad");
  add("6-4", text.number(predicted, "The hip oscillates in each swing", "",
                         "turning points of its error, the fewest in a swing",
                         run.summary("phases.swing.joints.hip.fewest_turning_points"), "",
                         analysis::another(2, 1000),
                         "an oscillation has two turning points at least; in its angle these are "
                         "shoulders: it never goes back"));
  add("6-4",
      text.number(
          predicted, "The hip's oscillations are small", "",
          "their amplitude in the mean, of the hip's excursion",
          100 * run.summary("phases.swing.joints.hip.oscillation_amplitude_rad") / excursion, "%",
          analysis::small(100), "6.3 has \"a few\", too, without a number: not judged"));
  add("6-4", text.number(predicted, "The hip oscillates at the beginning of each swing", "",
                         "share of swing after which the hip turns no more, mean of the steps",
                         last_turn(run), "%", analysis::another(0, 50),
                         "the beginning: no more than the first half"));
  add("6-4", text.number(predicted, "There are no noticeable oscillations at the knee", "",
                         "largest amplitude of its error in a swing, of its excursion",
                         largest_swing(run, "knee"), "%", analysis::negligible(100)));
  for (const char* joint : {"hip", "knee"})
    add("6-4",
        Section("7.1").number(
            predicted,
            std::string("Stable with the foot on the ground too, by the gains of the swing: ") +
                joint,
            "", "turning points of its error in propulsion, the most in one",
            run.summary(std::string("phases.propulsion.joints.") + joint + ".most_turning_points"),
            "", analysis::another(0, 1),
            "\"stable\" is taken to be: no oscillation in propulsion, as one has two turning "
            "points"));
  add("6-4", text.number(predicted, "The joints turn only from about the middle of propulsion on",
                         "the middle", "share of propulsion until the hip has moved by 0.5 deg",
                         standing_share(run), "", analysis::about(0.5)));
  add("6-7", text.number(predicted, "In swing the torque has a slope, since gravity's part changes",
                         "", "least change at the hip over the second half of swing, of its range",
                         change_of(run, "/joint/hip/torque"), "%", analysis::noticeable(100)));
  add("6-8", text.number(predicted, "A spike of the normal force when the foot is set down", "",
                         "fall after it within half of propulsion, of the largest normal force",
                         spike(run), "%", analysis::noticeable(100), "",
                         "our foot comes down softly: its force rises over a tenth of a second and "
                         "stays"));
  add_run("6-9", "no-drag", "trolley.mean_speed", "Without the foam in the roller: mean speed");
  double others = 0;
  for (const char* valve : {"knee_flexor/inlet", "knee_extensor/inlet", "knee_extensor/exhaust"})
    others = std::max(others, largest_duty(run, valve));
  add("6-11", text.number(fitted, "The flexor's exhaust has the highest duty cycle", "",
                          "its largest less the largest of the other three, from the first "
                          "propulsion on",
                          largest_duty(run, "knee_flexor/exhaust") - others, "%",
                          analysis::at_least(0), "table 6-4's duties were fitted"));
  add("6-11",
      text.number(predicted, "For most of propulsion the flexor has no more than the room's air",
                  "", "share of propulsion with less than 5 psi gauge in it",
                  empty_for(run, "knee_flexor"), "%", analysis::another(50, 100),
                  "\"most\": more than half"));
  add_run("6-11", "walk-reachable", "passiveness",
          "Passiveness, if what is desired could be reached");
}

}  // namespace sinew::thesis
