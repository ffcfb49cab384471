#include "sinew/identify/motion/dynamic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/actuator/hysteresis.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

using actuator::Loss;
using Scale = Loss::Scale;

struct Law {
  const char* name;
  const char* law;
  const char* source;
  bool viscous, dry;
  Scale scale;
};

constexpr std::array laws{
    Law{"viscous", "F = c v", "[33] without its dry part", true, false, Scale::secant},
    Law{"dry_constant", "F = Q k sign v, k constant", "Coulomb", false, true, Scale::constant},
    Law{"dry_secant", "F = Q k sign v, k the secant [34]", "[33], [34]", false, true,
        Scale::secant},
    Law{"dry_sealed", "F = Q k sign v, k of the sealed muscle", "[33], [45]", false, true,
        Scale::sealed},
    Law{"constant", "F = c v + Q k sign v, k constant", "[33], Coulomb", true, true,
        Scale::constant},
    Law{"secant", "F = c v + Q k sign v, k the secant [34]", "[33], [34]", true, true,
        Scale::secant},
    Law{"sealed", "F = c v + Q k sign v, k of the sealed muscle", "[33], [45]", true, true,
        Scale::sealed}};

// Returns the number of parameters that all records share: c and Q, as far as the law has them.
std::size_t shared(const Law& law) { return (law.viscous ? 1u : 0u) + (law.dry ? 1u : 0u); }

// Returns the stiffness of the constant laws, so that their Q is comparable with that of others.
double middle_stiffness(std::span<const Swing> swings) {
  std::vector<double> all;
  for (const Swing& s : swings) all.push_back(s.stiffness());
  return median(all);
}

Loss loss_of(const Law& law, std::span<const double> p, double stiffness) {
  Loss out{.coulomb_scale = law.scale};
  if (law.viscous) out.viscous = p[0];
  if (law.dry) out.coulomb_length = p[law.viscous ? 1 : 0];
  if (law.scale == Scale::constant) out.coulomb_stiffness = stiffness;
  return out;
}

// A record in a joint fit, up to some sample.
struct Part {
  const Swing* swing;
  std::size_t samples;
};

// Lengths of all parts, one after the other. A part whose parameters have not changed since the
// last call is not integrated again.
class Trajectories {
 public:
  Trajectories(const Law& law, std::vector<Part> parts, double stiffness)
      : law_(law), parts_(std::move(parts)), stiffness_(stiffness), last_(parts_.size()) {}

  bool operator()(std::span<const double> p, std::span<double> lengths) {
    const std::size_t common = shared(law_);
    std::size_t from = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const auto own = p.subspan(common + i * Swing::nuisances, Swing::nuisances);
      std::vector<double> key(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(common));
      key.insert(key.end(), own.begin(), own.end());
      if (!last_[i].known || key != last_[i].key) {
        last_[i] = {key, std::vector<double>(parts_[i].samples), true};
        if (!parts_[i].swing->simulate(loss_of(law_, p, stiffness_), own, last_[i].lengths)) {
          last_[i].known = false;
          return false;
        }
      }
      std::ranges::copy(last_[i].lengths, lengths.begin() + static_cast<std::ptrdiff_t>(from));
      from += parts_[i].samples;
    }
    return true;
  }

 private:
  struct Last {
    std::vector<double> key, lengths;
    bool known = false;
  };
  const Law& law_;
  std::vector<Part> parts_;
  double stiffness_;
  std::vector<Last> last_;
};

// Start values of a fit.
struct Start {
  double viscous = 0, coulomb_length = 0;
  std::vector<Swing::Nuisance> nuisance;  // for each record
};

class Dynamic {
 public:
  Dynamic(std::span<const Swing> swings, std::span<const DecayRecord> records,
          const Constraints& constraints)
      : swings_(swings), constraints_(constraints), stiffness_(middle_stiffness(swings)) {
    for (std::size_t i = 0; i < records.size(); ++i)
      (records[i].held_out ? held_out_ : fitted_).push_back(i);
  }

  void start_from(std::span<const DecaySummary> summaries) {
    std::vector<double> c, q;
    for (const DecaySummary& s : summaries) {
      c.push_back(s.all.damping.viscous);
      q.push_back(s.all.damping.coulomb_length);
    }
    start_.viscous = std::max(median(c), 1e-3);
    start_.coulomb_length = std::max(median(q), 1e-6);
    const Loss loss{.viscous = start_.viscous,
                    .coulomb_length = start_.coulomb_length,
                    .coulomb_scale = Scale::sealed};
    for (const Swing& s : swings_) start_.nuisance.push_back(s.settle(loss));
  }

  // Fits the laws, or the one called `model`.
  void fit(std::string_view model, Report& report) const {
    std::vector<Candidate> candidates;
    for (const Law& law : laws) {
      Candidate c = candidate_of(law, fitted_, start_);
      c.left_out = [this, &law](const Solution& whole) { return unseen(law, whole); };
      if (law.scale == Scale::constant && law.dry)
        c.notes.push_back(fmt::format("k = {:.5g} N/m, of the sealed muscle at rest", stiffness_));
      candidates.push_back(std::move(c));
    }
    check_constraints(candidates);
    fit_candidates(std::move(candidates),
                   {.measured = measured_of(fitted_),
                    .has_band = false,
                    .shows_left_out = !held_out_.empty(),
                    .model = model},
                   report);
  }

  // Returns the samples in the order of the residuals.
  Rows rows() const {
    Rows out{.x = "time", .x_unit = "s"};
    for (const bool held_out : {false, true})
      for (const std::size_t i : held_out ? held_out_ : fitted_) {
        const Swing& s = swings_[i];
        out.add(s.time, s.length, s.file);
        out.held_out.resize(out.size(), held_out);
      }
    return out;
  }

  Loss loss(const Law& law, const Fit& fit) const {
    std::vector<double> p;
    for (std::size_t i = 0; i < shared(law); ++i) p.push_back(fit.parameters[i].value);
    return loss_of(law, p, stiffness_);
  }

 private:
  using Which = std::vector<std::size_t>;  // indices of records

  // Returns the parameters of the law and of these records.
  std::vector<Parameter> parameters_of(const Law& law, const Which& which,
                                       const Start& start) const {
    std::vector<Parameter> parameters;
    if (law.viscous)
      parameters.push_back({"viscous", "N s/m", start.viscous, 0, unbounded, start_.viscous});
    if (law.dry)
      parameters.push_back(
          {"coulomb_length", "m", start.coulomb_length, 0, unbounded, start_.coulomb_length});
    for (const std::size_t i : which)
      for (Parameter p : swings_[i].parameters(start.nuisance[i])) {
        if (swings_.size() > 1) p.name += " of " + swings_[i].file;
        parameters.push_back(std::move(p));
      }
    return parameters;
  }

  // Returns the number of samples up to this share of a record.
  std::size_t samples_of(std::size_t record, double share) const {
    const Swing& swing = swings_[record];
    return share < 1 ? swing.samples_until(share) : swing.time.size();
  }

  std::vector<double> measured_of(const Which& which, double share = 1) const {
    std::vector<double> out;
    for (const std::size_t i : which) {
      const auto from = swings_[i].length.begin();
      out.insert(out.end(), from, from + static_cast<std::ptrdiff_t>(samples_of(i, share)));
    }
    return out;
  }

  Candidate candidate_of(const Law& law, const Which& which, const Start& start,
                         double share = 1) const {
    std::vector<Part> parts;
    for (const std::size_t i : which) parts.push_back({&swings_[i], samples_of(i, share)});
    return {.model = law.name,
            .law = law.law,
            .source = law.source,
            .parameters = parameters_of(law, which, start),
            .predict = Trajectories(law, parts, stiffness_),
            .options = {.correlated = true},
            .constraints = constraints_,
            .may_be_at_bounds = true};
  }

  Solution solved(const Law& law, const Which& which, const Start& start, double share = 1) const {
    return solve(candidate_of(law, which, start, share), measured_of(which, share));
  }

  // Returns the residuals of data that are held out.
  std::vector<double> unseen(const Law& law, const Solution& all) const {
    if (swings_.size() == 1) return last_third(law, all);
    const bool marked = !held_out_.empty();
    std::vector<double> out;
    for (const std::size_t i : marked ? held_out_ : fitted_) {
      const Loss loss = marked ? loss_of(law, all.values, stiffness_) : loss_without(law, all, i);
      const std::vector<double> r =
          residuals_of(swings_[i], loss, swings_[i].settle(loss, start_.nuisance[i]));
      out.insert(out.end(), r.begin(), r.end());
    }
    return out;
  }

  // Returns the solution as a start for a part of the records.
  Start start_at(const Law& law, const Solution& s) const {
    Start out = start_;
    if (law.viscous) out.viscous = s.values[0];
    if (law.dry) out.coulomb_length = s.values[law.viscous ? 1 : 0];
    for (std::size_t i = 0; i < fitted_.size(); ++i)
      for (std::size_t k = 0; k < Swing::nuisances; ++k)
        out.nuisance[fitted_[i]][k] = s.values[shared(law) + i * Swing::nuisances + k];
    return out;
  }

  Loss loss_without(const Law& law, const Solution& all, std::size_t left_out) const {
    Which which = fitted_;
    std::erase(which, left_out);
    return loss_of(law, solved(law, which, start_at(law, all)).values, stiffness_);
  }

  static std::vector<double> residuals_of(const Swing& swing, const Loss& loss,
                                          std::span<const double> nuisance) {
    std::vector<double> r(swing.time.size());
    if (!swing.simulate(loss, nuisance, r)) r.assign(r.size(), swing.rest);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= swing.length[i];
    return r;
  }

  // Predicts the last third from a fit to the first two thirds.
  std::vector<double> last_third(const Law& law, const Solution& all) const {
    constexpr double seen = 2.0 / 3;
    const Solution s = solved(law, fitted_, start_at(law, all), seen);
    const std::vector<double> r = residuals_of(swings_[0], loss_of(law, s.values, stiffness_),
                                               std::span(s.values).subspan(shared(law)));
    return {r.begin() + static_cast<std::ptrdiff_t>(swings_[0].samples_until(seen)), r.end()};
  }

  std::span<const Swing> swings_;
  const Constraints& constraints_;
  Which fitted_, held_out_;
  double stiffness_;
  Start start_;
};

DecaySummary summary_of(const Swing& swing) {
  const Oscillation& o = swing.oscillation;
  const double mass = swing.stand.mass;
  DecaySummary out{.swing = swing, .all = decay_fit(o, mass)};
  try {
    const TwoPoints p = two_points(o, swing.rest, swing.file);
    out.printed = two_point(p.x1, p.dx1, p.x2, p.dx2, mass, o.period, DecayForm::printed);
    out.exact = two_point(p.x1, p.dx1, p.x2, p.dx2, mass, o.period, DecayForm::exact);
  } catch (const Refusal& e) {
    out.why_not = e.what();
  }
  return out;
}

void refuse_memory(const DecayRecord& record) {
  const actuator::Actuator& a = record.stand.actuator;
  const bool lags = actuator::has_hysteresis(a.hysteresis);
  const bool creeps = a.creep.share[0] > 0 || a.creep.share[1] > 0;
  if (lags || creeps)
    throw Refusal(
        fmt::format("actuator {}", a.name), lags ? "a hysteresis" : "creep",
        "an actuator without it: the loss to be found is the only one of these trajectories",
        "a file without it");
}

std::string held_out_is(std::span<const DecayRecord> records, bool marked) {
  if (records.size() == 1) return "the last third of the record, from a fit to the first two";
  if (!marked) return "each record in turn";
  std::string out;
  for (const DecayRecord& r : records)
    if (r.held_out) out += (out.empty() ? "" : ", ") + r.data.file;
  return out;
}

}  // namespace

std::vector<std::string> dynamic_models() { return names_of_laws(laws); }

DynamicResult identify_dynamic(std::span<const DecayRecord> records, std::string_view model,
                               const Constraints& constraints) {
  if (records.empty()) throw Refusal("data", "no record", "one free decay at least", "");
  std::vector<Swing> swings;
  std::size_t marked = 0;
  DynamicResult out;
  for (const DecayRecord& r : records) {
    refuse_memory(r);
    swings.emplace_back(r);
    marked += r.held_out;
    out.records.push_back(summary_of(swings.back()));
  }
  if (marked == records.size())
    throw Refusal("data", "every record held out", "one at least to fit", "");

  Report& report = out.report;
  report.set_subject("losses in motion", "length", "m", "the largest first amplitude");
  report.held_out_is = held_out_is(records, marked > 0);
  report.not_shown = {"the losses at other pressures and amplitudes, and in a steady motion"};
  for (const Swing& s : swings) {
    report.full_scale = std::max(report.full_scale, s.amplitude);
    report.notes.insert(report.notes.end(), s.notes.begin(), s.notes.end());
  }
  Dynamic dynamic(swings, records, constraints);
  dynamic.start_from(out.records);
  dynamic.fit(model, report);
  report.rows = dynamic.rows();
  conclude(report);
  out.loss = dynamic.loss(*std::ranges::find(laws, report.best().model, &Law::name), report.best());
  for (std::size_t i = 0; i < swings.size(); ++i)
    out.records[i].friction = swings[i].friction(out.loss);
  for (const Estimate& e : report.best().parameters)
    if (e.name.starts_with("tension") && std::abs(e.value - 1) > 0.05)
      report.warnings.push_back(
          fmt::format("{}: rest and period require {:.3f} times the tension of the actuator's file",
                      e.name, e.value));
  return out;
}

}  // namespace sinew::identify
