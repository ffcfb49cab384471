#include "sinew/identify/pair/pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/pair/pair_problem.h"
#include "sinew/identify/pair/pair_rows.h"

namespace sinew::identify {

namespace {

using Selection = std::vector<PairRows>;  // of each recording

constexpr const char* effort_of(bool rotary) { return rotary ? "torque" : "force"; }

double square_sum(const Solution& s) {
  return s.rms * s.rms * static_cast<double>(s.residuals.size());
}

// A law that was fitted, with what comes of it.
struct Fitted {
  Fit fit;
  std::vector<double> values;
  Solution solution;
};

class Pair {
 public:
  Pair(std::span<const PairRecord> records, const PairOptions& options) : options_(options) {
    for (const PairRecord& r : records) (r.held_out ? others_ : fitted_).push_back(r);
    if (fitted_.empty())
      throw Refusal("data", "every recording held out", "one at least to fit", "");
    for (const PairRecord& r : fitted_) {
      thinned_.push_back(pair_thinned(r));
      thinned_rows_.push_back(
          pair_rows(thinned_.back(), options.held_out_from, options.held_out_to, false));
      rows_.push_back(pair_rows(r, options.held_out_from, options.held_out_to, false));
      unseen_.push_back(pair_rows(r, options.held_out_from, options.held_out_to, true));
      refuse_too_few(r, rows_.back());
      for (const double f : r.effort) full_scale_ = std::max(full_scale_, std::abs(f));
    }
  }

  Fitted fit(const PairLaw& law) const {
    Fitted out{.fit = {.model = law.name, .law = law.law, .source = law.source}};
    try {
      PairProblem problem(law, fitted_), thinned(law, thinned_);
      const Solution near = thinned.solve(thinned_rows_, thinned.starts(), options_.wishes, false);
      out.solution = problem.solve(rows_, {{near.values}}, options_.wishes, true);
      out.values = out.solution.values;
      out.fit.parameters = out.solution.estimates;
      out.fit.fit = scored(problem, out.values, fitted_, rows_);
      cross_validate(thinned, out.values, out.fit);
      hold_out(law, problem, out);
      tell_residuals(law, problem, out);
      judge(law, out.fit);
    } catch (const Refusal& e) {
      out.fit.refused = e.what();
    }
    return out;
  }

  // A delay shifts kinks over samples: what is left of the effort is rough in it, and its slope at
  // the best place says too little. The interval has every delay of a grid with which the others
  // leave hardly more.
  void widen_delays(const PairLaw& law, Fitted& fitted) const {
    constexpr double most = 0.1, step = 0.02;
    PairProblem thinned(law, thinned_);
    for (std::size_t i = 0; i < fitted.values.size(); ++i) {
      Estimate& e = fitted.fit.parameters[i];
      if (!e.name.starts_with("delay") || !e.free || e.at_bound) continue;
      const Solution best = thinned.solve(thinned_rows_, {{fitted.values}}, options_.wishes, true);
      const double t = t_quantile(std::max(1, best.freedom));
      const double more = t * t * std::pow(best.standard_deviation, 2) * best.inflation;
      for (int k = -5; k <= 5; ++k) {
        const double delay = std::clamp(k * step, -most, most);
        if (delay > e.low && delay < e.high) continue;
        const Solution at =
            thinned.solve_with(thinned_rows_, fitted.values, options_.wishes, i, delay);
        if (square_sum(at) - square_sum(best) > more) continue;
        e.low = std::min(e.low, delay);
        e.high = std::max(e.high, delay);
      }
      e.identifiable = e.high - e.low < most;
    }
  }

  // Recordings that are held out follow those that are fitted.
  Rows rows() const {
    Rows out{.x = "time", .x_unit = "s"};
    const auto add = [&](const PairRecord& r, const PairRows* unseen) {
      out.at.insert(out.at.end(), r.time.begin(), r.time.end());
      out.measured.insert(out.measured.end(), r.effort.begin(), r.effort.end());
      out.group.resize(out.size(), r.file);
      out.held_out.resize(out.size(), unseen == nullptr);
      const std::size_t from = out.size() - r.size();
      for (std::size_t i = 0; unseen && i < unseen->size(); ++i)
        out.held_out[from + (*unseen)[i]] = true;
    };
    for (std::size_t k = 0; k < fitted_.size(); ++k) add(fitted_[k], &unseen_[k]);
    for (const PairRecord& r : others_) add(r, nullptr);
    return out;
  }

  std::string held_out_is() const {
    std::string out;
    const double from = options_.held_out_from, to = options_.held_out_to;
    if (from <= to)
      out = !std::isfinite(to)     ? fmt::format("each recording from {:g} s on", from)
            : !std::isfinite(from) ? fmt::format("each recording up to {:g} s", to)
                                   : fmt::format("{:g} to {:g} s of each recording", from, to);
    for (const PairRecord& r : others_) out += (out.empty() ? "" : ", ") + r.file;
    return out;
  }

  std::span<const PairRecord> fitted() const { return thinned_; }
  std::span<const PairRows> fitted_rows() const { return thinned_rows_; }
  double full_scale() const { return full_scale_; }

 private:
  static void refuse_too_few(const PairRecord& r, const PairRows& rows) {
    constexpr std::size_t least = 50;
    if (rows.size() < least)
      throw Refusal(r.file, fmt::format("{} samples that are not held out", rows.size()),
                    fmt::format("at least {}", least), "another time to hold out");
  }

  Score scored(PairProblem& problem, std::span<const double> p, std::span<const PairRecord> records,
               const Selection& rows) const {
    std::vector<double> r;
    problem.residuals(p, rows, r);
    return with_explained(r, records, rows);
  }

  Score with_explained(std::span<const double> r, std::span<const PairRecord> records,
                       const Selection& rows) const {
    std::vector<double> measured;
    for (std::size_t k = 0; k < records.size(); ++k)
      for (const std::size_t i : rows[k]) measured.push_back(records[k].effort[i]);
    Score out = score(r, full_scale_);
    out.explained = pair_explained(r, measured);
    return out;
  }

  // Each block of time predicted from the others, in all recordings at once.
  void cross_validate(PairProblem& problem, const std::vector<double>& from, Fit& fit) const {
    std::vector<double> all, some;
    for (std::size_t b = 0; b < pair_blocks; ++b) {
      Selection others, block;
      for (const PairRows& r : thinned_rows_) {
        others.push_back(pair_block(r, b, false));
        block.push_back(pair_block(r, b, true));
      }
      const Solution s = problem.solve(others, {{from}}, options_.wishes, false);
      problem.residuals(s.values, block, some);
      all.insert(all.end(), some.begin(), some.end());
    }
    fit.cross_validated = score(all, full_scale_);
    fit.band = band_of(all);
  }

  // What was not fitted: times of these recordings, and recordings of which only what is theirs -
  // bias, start - is fitted.
  void hold_out(const PairLaw& law, PairProblem& problem, Fitted& out) const {
    std::vector<double> all, measured;
    problem.residuals(out.values, unseen_, all);
    for (std::size_t k = 0; k < fitted_.size(); ++k)
      for (const std::size_t i : unseen_[k]) measured.push_back(fitted_[k].effort[i]);
    for (const PairRecord& other : others_) {
      const std::vector<double> r = residuals_of_other(law, out, other);
      all.insert(all.end(), r.begin(), r.end());
      measured.insert(measured.end(), other.effort.begin(), other.effort.end());
    }
    if (all.empty()) return;
    out.fit.held_out = score(all, full_scale_);
    out.fit.held_out->explained = pair_explained(all, measured);
  }

  // Physics and the sensors of its rig as they were found; its bias, its start and the sensors of a
  // rig that nobody fitted are its own.
  std::vector<double> residuals_of_other(const PairLaw& law, const Fitted& known,
                                         const PairRecord& other) const {
    std::vector<PairRecord> all = fitted_;
    all.push_back(other);
    PairProblem problem(law, all, fitted_.size());
    Selection rows(fitted_.size());
    rows.push_back(pair_rows(other, -unbounded, unbounded, true));
    std::vector<double> r;
    problem.residuals(problem.settled(rows, known.solution), rows, r);
    return r;
  }

  void tell_residuals(const PairLaw& law, PairProblem& problem, Fitted& out) const {
    Selection all;
    for (const PairRecord& r : fitted_) all.push_back(pair_rows(r, -unbounded, unbounded, true));
    problem.residuals(out.values, all, out.fit.residuals);
    for (const PairRecord& other : others_) {
      const std::vector<double> r = residuals_of_other(law, out, other);
      out.fit.residuals.insert(out.fit.residuals.end(), r.begin(), r.end());
    }
  }

  // Says what the law's parameters cannot be.
  void judge(const PairLaw& law, Fit& fit) const {
    std::string at_bound, unknown;
    for (const Estimate& e : fit.parameters) {
      const bool physics = e.name == "stiffness" || e.name == "area" || e.name == "viscous" ||
                           e.name == "mass" || e.name == "inertia" || e.name == "friction" ||
                           e.name == "fade_time";
      if (e.free && e.at_bound && physics) at_bound += (at_bound.empty() ? "" : ", ") + e.name;
      if (e.free && (e.name == "stiffness" || e.name == "area") && !e.identifiable)
        unknown += (unknown.empty() ? "" : " and ") + e.name;
      if (e.name == "presliding" && e.free && (e.at_bound || !(e.low > 0)))
        fit.notes.push_back(
            "presliding: not told from none; it slips within what the position resolves");
      if (e.name == "fade_time")
        fit.notes.push_back(
            "fade_time: how soon nothing is known of the friction of a pair that "
            "stands still; a property of the motion, not of a material");
    }
    if (!at_bound.empty()) fit.not_chosen = at_bound + " at the bound of its range";
    if (law.spring && law.air &&
        (!unknown.empty() || at_bound.find("stiffness") != at_bound.npos ||
         at_bound.find("area") != at_bound.npos))
      fit.not_chosen =
          "stiffness and area cannot be told apart: the pressures follow the position; "
          "freeze one of them";
  }

  const PairOptions& options_;
  std::vector<PairRecord> fitted_, others_;
  Selection rows_, unseen_;  // of those that are fitted
  std::vector<PairRecord> thinned_;
  Selection thinned_rows_;
  double full_scale_ = 0;
};

std::vector<const PairLaw*> laws_of(std::string_view model, std::span<const PairRecord> records) {
  std::vector<const PairLaw*> out;
  const bool pressures =
      std::ranges::all_of(records, [](const PairRecord& r) { return !r.pressure.empty(); });
  for (const PairLaw& law : pair_laws())
    if (model.empty() ? pressures || !law.air : model == law.name) out.push_back(&law);
  if (out.empty()) throw std::invalid_argument(fmt::format("no model {}", model));
  return out;
}

void check_wishes(const Pair& pair, const Wishes& wishes, bool pressures) {
  if (wishes.empty()) return;
  std::vector<Parameter> all;
  for (const PairLaw& law : pair_laws()) {
    if (law.air && !pressures) continue;
    const PairProblem problem(law, pair.fitted());
    all.insert(all.end(), problem.parameters().begin(), problem.parameters().end());
  }
  if (pressures)
    for (Parameter& p : pair_air_parameters(pair.fitted())) all.push_back(std::move(p));
  wishes.check(all);
}

// Elastic stiffness and what the air adds as it moves along.
PairStiffness stiffness_of(const PairLaw& law, const Fitted& fitted,
                           const std::optional<PairAir>& air) {
  const double per = air ? air->per_position : 0;
  const Solution& s = fitted.solution;
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(s.estimates, name, &Estimate::name) -
                                    s.estimates.begin());
  };
  const std::size_t n = s.values.size(), k = place("stiffness"), a = place("area");
  const auto cov = [&](std::size_t i, std::size_t j) { return s.covariance[i * n + j]; };
  PairStiffness out{.air = std::numeric_limits<double>::quiet_NaN()};
  double variance = 0;
  if (law.spring) out.value += s.values[k], variance += cov(k, k);
  if (law.air) {
    out.air = per * s.values[a];
    out.value += out.air;
    variance += per * per * cov(a, a);
  }
  if (law.spring && law.air) variance += 2 * per * cov(k, a);
  out.uncertainty = t_quantile(std::max(1, s.freedom)) * std::sqrt(std::max(variance, 0.0));
  return out;
}

void refuse_mixed(std::span<const PairRecord> records) {
  if (records.empty()) throw Refusal("data", "no recording", "one at least", "");
  for (const PairRecord& r : records)
    if (r.rotary != records[0].rotary)
      throw Refusal(r.file,
                    fmt::format("{}; {} has {}", effort_of(r.rotary), records[0].file,
                                effort_of(records[0].rotary)),
                    "recordings of slides, or of joints", "");
}

void tell_what_is_apart(const PairResult& found, Report& report) {
  if (found.sensors.size() == 1 || report.fits.empty())
    report.notes.push_back(
        "gain: that of one rig cannot be told from its stiffness, friction and losses; it counts "
        "as 1");
  if (!found.air) return;
  const bool apart = found.law.air && found.law.spring;
  if (!apart)
    report.notes.push_back(fmt::format(
        "elastic and trapped-air stiffness are told together only, {:.4g} {}: the pressures follow "
        "the position by {:.4g} Pa/{}; freeze area or stiffness to part them",
        found.stiffness.value, found.rotary ? "N m/rad" : "N/m", found.air->per_position,
        found.rotary ? "rad" : "m"));
}

}  // namespace

std::vector<std::string> pair_models() {
  std::vector<std::string> out;
  for (const PairLaw& law : pair_laws()) out.emplace_back(law.name);
  return out;
}

PairResult identify_pair(std::span<const PairRecord> records, const PairOptions& options) {
  refuse_mixed(records);
  const Pair pair(records, options);
  const std::vector<const PairLaw*> laws = laws_of(options.model, records);
  const bool pressures = !records[0].pressure.empty();
  check_wishes(pair, options.wishes, pressures);

  PairResult out{.rotary = records[0].rotary};
  Report& report = out.report;
  report.subject = "sealed pair that is moved";
  report.quantity = effort_of(out.rotary);
  report.unit = out.rotary ? "N m" : "N";
  report.full_scale = pair.full_scale();
  report.full_scale_is = fmt::format("the largest {}", report.quantity);
  report.held_out_is = pair.held_out_is();
  for (const PairRecord& r : records)
    report.notes.insert(report.notes.end(), r.notes.begin(), r.notes.end());
  std::vector<Fitted> fitted;
  for (const PairLaw* law : laws) fitted.push_back(pair.fit(*law));
  for (const Fitted& f : fitted) report.fits.push_back(f.fit);
  report.rows = pair.rows();
  choose(report);

  Fitted& best = fitted[report.chosen];
  pair.widen_delays(*laws[report.chosen], best);
  report.fits[report.chosen] = best.fit;
  out.law = *laws[report.chosen];
  const PairProblem problem(out.law, pair.fitted());
  out.values = problem.values(best.values);
  for (std::size_t k = 0; k < pair.fitted().size(); ++k)
    out.sensors.push_back(
        {pair.fitted()[k].file, pair.fitted()[k].rig, problem.sensors(best.values, k)});
  if (pressures) out.air = identify_pair_air(pair.fitted(), pair.fitted_rows(), options.wishes);
  out.stiffness = stiffness_of(out.law, best, out.air);
  tell_what_is_apart(out, report);
  return out;
}

}  // namespace sinew::identify
