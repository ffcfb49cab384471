#include "sinew/identify/pair/pair_air.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

namespace {

struct AirLaw {
  const char* name;
  const char* law;
  bool each, leaks;
};

constexpr std::array air_laws{AirLaw{"alike", "P = P_0 exp(-+ s (x - x_0)), one s", false, false},
                              AirLaw{"each", "P = P_0 exp(-+ s (x - x_0))", true, false},
                              AirLaw{"leaking", "P = P_0 exp(-+ s (x - x_0) - l t)", true, true}};

using Records = std::span<const PairRecord>;
using Selection = std::vector<PairRows>;  // one for each recording

std::string of(std::string name, Records records, std::size_t i) {
  return records.size() > 1 ? name + " of " + records[i].file : name;
}

double mean_of(const std::vector<double>& values, const PairRows& rows) {
  double sum = 0;
  for (const std::size_t i : rows) sum += values[i];
  return sum / static_cast<double>(rows.size());
}

// Returns the slope of the pressure over the position by least squares over all recordings.
double slope_of(Records records, std::size_t muscle, const Selection& selection) {
  double xy = 0, xx = 0;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const PairRecord& r = records[k];
    const double x0 = mean_of(r.at, selection[k]), p0 = mean_of(r.pressure[muscle], selection[k]);
    for (const std::size_t i : selection[k]) {
      xy += (r.at[i] - x0) * (r.pressure[muscle][i] - p0);
      xx += (r.at[i] - x0) * (r.at[i] - x0);
    }
  }
  return xx > 0 ? xy / xx : 0;
}

// One law on all recordings. Parameters: a of each muscle, leak of each muscle, delay of the
// pressures, then P_start of each muscle in each recording.
class TrappedAir {
 public:
  TrappedAir(const AirLaw& law, Records records) : law_(law), records_(records) {
    muscles_ = records[0].pressure.size();
    for (const PairRecord& r : records) {
      center_.push_back(0);
      for (const double x : r.at) center_.back() += x / static_cast<double>(r.size());
      delayed_.emplace_back(r.size());
    }
  }

  std::size_t slopes() const { return law_.each ? muscles_ : 1; }
  std::size_t common() const { return slopes() + (law_.leaks ? muscles_ : 0) + 1; }

  std::vector<Parameter> parameters(const Selection& rows) const {
    const std::string per = records_[0].rotary ? "1/rad" : "1/m";
    std::vector<Parameter> out;
    const auto name = [](const char* what, std::size_t m) {
      return fmt::format("{}_{}", what, m + 1);
    };
    for (std::size_t m = 0; m < slopes(); ++m) {
      const double slope = slope_of(records_, m, rows) / mean_of(records_[0].pressure[m], rows[0]);
      out.push_back({law_.each ? name("slope", m) : "slope", per, slope * sign(m, rows), -unbounded,
                     unbounded, std::max(std::abs(slope), 1e-6)});
    }
    for (std::size_t m = 0; law_.leaks && m < muscles_; ++m)
      out.push_back({.name = name("leak", m), .unit = "1/s", .scale = 1e-3});
    out.push_back({"pressure_delay", "s", 0, -0.2, 0.2, 0.01, true});
    for (std::size_t k = 0; k < records_.size(); ++k)
      for (std::size_t m = 0; m < muscles_; ++m) {
        const double p = mean_of(records_[k].pressure[m], rows[k]);
        out.push_back(
            {of(name("pressure", m), records_, k), "Pa abs", p, 0.5 * p, 2 * p, 0.01 * p});
      }
    return out;
  }

  // Returns 1 if the muscle's pressure rises with the position, else -1.
  double sign(std::size_t m, const Selection& rows) const {
    return slope_of(records_, m, rows) < 0 ? -1 : 1;
  }

  // Writes the pressures, muscle by muscle, at these rows.
  void predict(std::span<const double> p, const Selection& rows, std::span<const double> signs,
               std::span<double> out) {
    std::size_t at = 0;
    const double delay = p[common() - 1];
    for (std::size_t k = 0; k < records_.size(); ++k) {
      const PairRecord& r = records_[k];
      delayed(r.time, r.at, delay, delayed_[k]);
      for (std::size_t m = 0; m < muscles_; ++m) {
        const double s = signs[m] * p[law_.each ? m : 0], p0 = p[common() + k * muscles_ + m];
        const double leak = law_.leaks ? p[slopes() + m] : 0;
        for (const std::size_t i : rows[k])
          out[at++] =
              p0 * std::exp(s * (delayed_[k][i] - center_[k]) - leak * (r.time[i] - r.time[0]));
      }
    }
  }

  std::size_t muscles() const { return muscles_; }

 private:
  const AirLaw& law_;
  Records records_;
  std::size_t muscles_ = 0;
  std::vector<double> center_;
  std::vector<std::vector<double>> delayed_;
};

std::vector<double> signs_of(const TrappedAir& air, const Selection& rows) {
  std::vector<double> out;
  for (std::size_t m = 0; m < air.muscles(); ++m) out.push_back(air.sign(m, rows));
  return out;
}

Candidate candidate_of(const AirLaw& law, Records records, const Selection& rows,
                       const Constraints& constraints) {
  TrappedAir air(law, records);
  Candidate out{.model = law.name,
                .law = law.law,
                .source = "P V^n constant, to first order",
                .parameters = air.parameters(rows),
                .options = {.correlated = true},
                .constraints = constraints,
                .may_be_at_bounds = true};
  out.predict = [air, rows, signs = signs_of(air, rows)](std::span<const double> p,
                                                         std::span<double> values) mutable {
    air.predict(p, rows, signs, values);
    return true;
  };
  return out;
}

// Returns the block of time of each row.
std::vector<int> blocks_of(Records records, const Selection& rows) {
  std::vector<int> out;
  for (std::size_t k = 0; k < records.size(); ++k)
    for (std::size_t m = 0; m < records[k].pressure.size(); ++m)
      for (std::size_t i = 0; i < rows[k].size(); ++i)
        out.push_back(static_cast<int>(i * pair_blocks / rows[k].size()));
  return out;
}

Rows rows_of(Records records, const Selection& selection) {
  Rows out{.x = records[0].rotary ? "angle" : "displacement",
           .x_unit = records[0].rotary ? "rad" : "m",
           .unit = "Pa abs"};
  for (std::size_t k = 0; k < records.size(); ++k)
    for (std::size_t m = 0; m < records[k].pressure.size(); ++m)
      for (const std::size_t i : selection[k]) {
        out.at.push_back(records[k].at[i]);
        out.measured.push_back(records[k].pressure[m][i]);
        out.group.push_back(of(fmt::format("muscle {}", m + 1), records, k));
      }
  return out;
}

void read_off(Records records, const Selection& rows, PairAir& out) {
  const Fit& best = out.report.best();
  const std::size_t muscles = records[0].pressure.size();
  const bool each = best.model != air_laws[0].name;
  for (std::size_t m = 0; m < muscles; ++m) {
    out.slope.push_back(best.parameters[each ? m : 0].value);
    out.falls.push_back(slope_of(records, m, rows) < 0);
    double mean = 0;
    const std::size_t first = best.parameters.size() - records.size() * muscles;
    for (std::size_t k = 0; k < records.size(); ++k)
      mean += best.parameters[first + k * muscles + m].value / static_cast<double>(records.size());
    out.pressure.push_back(mean);
    out.per_position += (muscles == 1 ? 2 : 1) * out.slope[m] * mean;
  }
  if (muscles == 2 && out.falls[0] == out.falls[1])
    out.report.warnings.push_back(
        "both pressures go the same way with the position: one muscle of a pair is stretched as "
        "the other shortens; check the columns");
}

}  // namespace

std::vector<Parameter> pair_air_parameters(Records records) {
  Selection rows;
  for (const PairRecord& r : records) rows.push_back(pair_rows(r, -unbounded, unbounded, true));
  std::vector<Parameter> out;
  for (const AirLaw& law : air_laws)
    for (Parameter& p : TrappedAir(law, records).parameters(rows)) out.push_back(std::move(p));
  return out;
}

PairAir identify_pair_air(Records records, std::span<const PairRows> fitted,
                          const Constraints& constraints) {
  for (const PairRecord& r : records)
    if (r.pressure.empty() || r.pressure.size() != records[0].pressure.size())
      throw Refusal(r.file, fmt::format("{} pressures", r.pressure.size()),
                    "as many in each recording, one or two",
                    "names.pressure_1=NAME, names.pressure_2=NAME");
  const Selection rows(fitted.begin(), fitted.end());
  PairAir out;
  Report& report = out.report;
  report.set_subject("air trapped by the pair", "pressure", "Pa diff", "the change of a pressure");
  for (std::size_t k = 0; k < records.size(); ++k)
    for (const std::vector<double>& p : records[k].pressure)
      report.full_scale = std::max(report.full_scale, largest(p) - smallest(p));
  if (!(report.full_scale > 0))
    throw Refusal(records[0].file, "pressures that do not change",
                  "those of sealed muscles that are moved", "the columns");
  report.rows = rows_of(records, rows);
  std::vector<Candidate> candidates;
  for (const AirLaw& law : air_laws)
    candidates.push_back(candidate_of(law, records, rows, constraints));
  fit_candidates(candidates,
                 {.measured = report.rows.measured,
                  .splits = each_part_held_out(blocks_of(records, rows)),
                  .cross_validates = true},
                 report);
  conclude(report);
  read_off(records, rows, out);
  return out;
}

}  // namespace sinew::identify
