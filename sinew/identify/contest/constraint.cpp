#include "sinew/identify/contest/constraint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

constexpr std::string_view names_of_kinds[] = {"freeze", "prior", "tie"};
constexpr std::string_view forms[] = {"NAME=VALUE", "NAME=VALUE±DEVIATION", "NAME=OTHER NAME"};

std::string setting_of(Constraint::Kind kind) {
  return std::string(names_of_kinds[static_cast<std::size_t>(kind)]);
}

[[noreturn]] void fail_constraint(const Constraint& constraint, const std::string& expected,
                                  const std::string& try_this = "") {
  config::fail({setting_of(constraint.kind), 0, 0}, "", config::in_quotes(constraint.text),
               expected, try_this);
}

// Splits value and deviation: "3.5±0.2 N s/m" and "3.5 N s/m ± 0.2 N s/m" are equivalent.
void split_prior(Constraint& constraint) {
  for (const std::string_view mark : {"±", "+-", "+/-"}) {
    const std::size_t at = constraint.value.find(mark);
    if (at == constraint.value.npos) continue;
    constraint.deviation =
        units::trimmed(std::string_view(constraint.value).substr(at + mark.size()));
    constraint.value = units::trimmed(std::string_view(constraint.value).substr(0, at));
    const std::size_t unit = constraint.deviation.find_first_not_of("0123456789.eE+-");
    if (constraint.value.find_first_not_of("0123456789.eE+-") == constraint.value.npos &&
        unit != constraint.deviation.npos)
      constraint.value += constraint.deviation.substr(unit);
    return;
  }
}

Constraint parse_constraint(Constraint::Kind kind, const std::string& text) {
  Constraint out{.kind = kind, .text = text};
  const std::string form(forms[static_cast<std::size_t>(kind)]);
  const std::size_t equals = text.find('=');
  if (equals == text.npos) fail_constraint(out, form);
  out.name = units::trimmed(std::string_view(text).substr(0, equals));
  out.value = units::trimmed(std::string_view(text).substr(equals + 1));
  if (kind == Constraint::Kind::prior) split_prior(out);
  const bool incomplete =
      kind == Constraint::Kind::prior && (out.deviation.empty() || out.value.empty());
  if (out.name.empty() || out.value.empty() || incomplete) fail_constraint(out, form);
  return out;
}

// Returns the number in SI; "0.3 SI" is in the SI unit already.
double number_of(const Constraint& constraint, const std::string& text, std::string_view unit,
                 const config::Range& range) {
  const std::string name = setting_of(constraint.kind);
  try {
    if (text.ends_with(" SI"))
      return config::number_setting(
          name, config::quantity(text.substr(0, text.size() - 3), "1", name), range);
    return config::quantity_setting(name, text, unit, units::atmosphere, range);
  } catch (const config::Error& e) {
    const config::Problem& p = e.problems().front();
    config::fail({name, 0, 0}, "", fmt::format("{} for {}", p.found, constraint.name), p.expected,
                 p.try_this);
  }
}

double value_of(const Constraint& constraint, const Parameter& p) {
  return number_of(constraint, constraint.value, p.unit,
                   {p.low, p.high, "the range of the parameter"});
}

double deviation_of(const Constraint& constraint, const Parameter& p) {
  return number_of(constraint, constraint.deviation, units::difference_unit(p.unit),
                   config::above_zero(unbounded, "a standard deviation"));
}

// Returns whether `name` is the parameter's or that of its kind: "delay" for "delay of a.csv".
bool names(std::string_view name, std::string_view parameter) {
  return parameter == name ||
         (parameter.starts_with(name) && parameter.substr(name.size()).starts_with(" of "));
}

const Parameter& named(const Constraint& constraint, std::string_view name,
                       std::span<const Parameter> all) {
  for (const Parameter& p : all)
    if (names(name, p.name)) return p;
  std::vector<std::string_view> there;
  for (const Parameter& p : all)
    if (std::ranges::find(there, p.name) == there.end()) there.push_back(p.name);
  config::fail({setting_of(constraint.kind), 0, 0}, "", config::in_quotes(name),
               "a parameter: " + config::either(there), config::closest_in_quotes(name, there));
}

constexpr const char* frozen_at_bound = "frozen at its bound";

// The problem without frozen and tied parameters, and the mapping back to all parameters.
struct Reduced {
  std::vector<Parameter> parameters;
  std::vector<int> place;  // index of each parameter in `parameters`; -1: frozen
  std::vector<double> frozen;
  std::vector<std::string> known;  // constraints in words
  struct Prior {
    std::size_t place;
    double value, deviation;
  };
  std::vector<Prior> priors;

  std::vector<double> all(std::span<const double> p) const {
    std::vector<double> out = frozen;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (place[i] >= 0) out[i] = p[static_cast<std::size_t>(place[i])];
    return out;
  }
};

void add_prior(const Constraint& constraint, Parameter p, std::size_t i, Reduced& out) {
  const Reduced::Prior prior{out.parameters.size(), value_of(constraint, p),
                             deviation_of(constraint, p)};
  out.priors.push_back(prior);
  out.known[i] = fmt::format("prior {:.4g} +- {:.2g}", prior.value, prior.deviation);
  p.start = prior.value;
  out.place[i] = static_cast<int>(out.parameters.size());
  out.parameters.push_back(std::move(p));
}

Reduced reduce(std::span<const Parameter> parameters, const Constraints& constraints) {
  const std::size_t n = parameters.size();
  Reduced out{.place = std::vector<int>(n, -1),
              .frozen = std::vector<double>(n),
              .known = std::vector<std::string>(n)};
  const auto index_of = [&](std::string_view name) {
    for (std::size_t i = 0; i < n; ++i)
      if (names(name, parameters[i].name)) return i;
    return n;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Constraint* constraint = constraints.of(parameters[i].name);
    const bool alone =
        constraint && constraint->kind == Constraint::Kind::tie && index_of(constraint->value) == n;
    if (!constraint || alone) {
      out.place[i] = static_cast<int>(out.parameters.size());
      out.parameters.push_back(parameters[i]);
    } else if (constraint->kind == Constraint::Kind::freeze) {
      out.frozen[i] = value_of(*constraint, parameters[i]);
      out.known[i] = constraint->at_bound ? frozen_at_bound : "frozen";
    } else if (constraint->kind == Constraint::Kind::prior) {
      add_prior(*constraint, parameters[i], i, out);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Constraint* constraint = constraints.of(parameters[i].name);
    if (!constraint || constraint->kind != Constraint::Kind::tie) continue;
    const std::size_t other = index_of(constraint->value);
    if (other == n) continue;
    out.place[i] = out.place[other];
    out.frozen[i] = out.frozen[other];
    out.known[i] = "tied to " + parameters[other].name;
  }
  return out;
}

// Returns derivatives by the reduced parameters: summed for tied ones, and with rows for the first
// priors.
Slopes slopes_of(const Slopes& slopes, std::size_t count, const Reduced& reduced,
                 std::size_t priors, double weight) {
  return [&slopes, count, &reduced, priors, weight](std::span<const double> p, std::span<double> r,
                                                    std::span<double> by) {
    const std::size_t rows = r.size();
    std::vector<double> each(count * reduced.place.size());
    if (!slopes(reduced.all(p), r.first(count), each)) return false;
    std::ranges::fill(by, 0.0);
    for (std::size_t i = 0; i < reduced.place.size(); ++i)
      for (std::size_t k = 0; k < count && reduced.place[i] >= 0; ++k)
        by[static_cast<std::size_t>(reduced.place[i]) * rows + k] += each[i * count + k];
    for (std::size_t i = 0; i < priors; ++i) {
      const Reduced::Prior& prior = reduced.priors[i];
      r[count + i] = weight * (p[prior.place] - prior.value) / prior.deviation;
      by[prior.place * rows + count + i] = weight / prior.deviation;
    }
    return true;
  };
}

Solution solve_reduced(const Residuals& residuals, std::size_t count, const Reduced& reduced,
                       double weight, const SolverOptions& options) {
  const std::size_t priors = weight > 0 ? reduced.priors.size() : 0;
  const Residuals all = [&](std::span<const double> p, std::span<double> r) {
    if (!residuals(reduced.all(p), r.first(count))) return false;
    for (std::size_t i = 0; i < priors; ++i) {
      const Reduced::Prior& prior = reduced.priors[i];
      r[count + i] = weight * (p[prior.place] - prior.value) / prior.deviation;
    }
    return true;
  };
  SolverOptions own = options;
  if (options.slopes) own.slopes = slopes_of(options.slopes, count, reduced, priors, weight);
  return least_squares(all, count + priors, reduced.parameters, own);
}

// Compares a prior with the estimate, in words.
std::string compared(const Reduced::Prior& prior, const Estimate& e) {
  const double away = std::abs(e.value - prior.value) / prior.deviation;
  if (away > 3) return fmt::format(", {:.1f} of its deviations away", away);
  if (e.standard_error > 0.9 * prior.deviation) return ", which the data do not narrow";
  return "";
}

// Returns the solution in all parameters.
Solution restored(Solution s, std::size_t count, std::span<const Parameter> parameters,
                  const Reduced& reduced) {
  Solution out = s;
  const std::size_t n = parameters.size(), m = reduced.parameters.size();
  out.values = reduced.all(s.values);
  out.residuals.resize(count);
  double sum = 0;
  for (const double r : out.residuals) sum += r * r;
  out.rms = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
  out.estimates.clear();
  out.covariance.assign(n * n, 0.0);
  std::vector<bool> taken(m, false);
  for (std::size_t i = 0; i < n; ++i) {
    const int at = reduced.place[i];
    const bool tied = reduced.known[i].starts_with("tied");
    Estimate e{.value = out.values[i], .low = out.values[i], .high = out.values[i]};
    if (at >= 0) e = s.estimates[static_cast<std::size_t>(at)];
    e.name = parameters[i].name;
    e.unit = parameters[i].unit;
    e.free = at >= 0 && !tied;
    e.known = reduced.known[i];
    e.at_bound |= e.known == frozen_at_bound;
    for (const Reduced::Prior& prior : reduced.priors)
      if (e.free && static_cast<int>(prior.place) == at) e.known += compared(prior, e);
    out.estimates.push_back(std::move(e));
    for (std::size_t k = 0; k < n; ++k)
      if (at >= 0 && reduced.place[k] >= 0)
        out.covariance[i * n + k] = s.covariance[static_cast<std::size_t>(at) * m +
                                                 static_cast<std::size_t>(reduced.place[k])];
  }
  return out;
}

}  // namespace

Constraints::Constraints(const ConstraintTexts& texts) {
  const std::vector<std::string>* lists[] = {&texts.freeze, &texts.prior, &texts.tie};
  for (std::size_t kind = 0; kind < std::size(lists); ++kind)
    for (const std::string& text : *lists[kind]) {
      Constraint constraint = parse_constraint(static_cast<Constraint::Kind>(kind), text);
      if (std::ranges::find(all_, constraint.name, &Constraint::name) != all_.end())
        fail_constraint(constraint, "one setting for a parameter");
      all_.push_back(std::move(constraint));
    }
}

void Constraints::check(std::span<const Parameter> all) const {
  for (const Constraint& constraint : all_) {
    const Parameter& p = named(constraint, constraint.name, all);
    if (constraint.kind != Constraint::Kind::tie) {
      (void)value_of(constraint, p);
      if (constraint.kind == Constraint::Kind::prior) (void)deviation_of(constraint, p);
      continue;
    }
    const Parameter& other = named(constraint, constraint.value, all);
    if (other.unit != p.unit) fail_constraint(constraint, "another parameter in " + p.unit);
    if (names(constraint.name, other.name) || names(constraint.value, p.name))
      fail_constraint(constraint, "another parameter");
    if (const Constraint* more = of(other.name); more && more->kind == Constraint::Kind::tie)
      fail_constraint(constraint, "a parameter that is not tied itself");
  }
}

Constraints Constraints::with_frozen(const std::string& parameter, double value,
                                     bool at_bound) const {
  Constraints out = *this;
  std::erase_if(out.all_,
                [&](const Constraint& constraint) { return constraint.name == parameter; });
  out.all_.push_back(
      {.name = parameter, .value = fmt::format("{:.17g} SI", value), .at_bound = at_bound});
  return out;
}

const Constraint* Constraints::of(std::string_view parameter) const {
  const Constraint* of_kind = nullptr;
  for (const Constraint& constraint : all_) {
    if (constraint.name == parameter) return &constraint;
    if (names(constraint.name, parameter)) of_kind = &constraint;
  }
  return of_kind;
}

Solution least_squares(const Residuals& residuals, std::size_t count,
                       std::span<const Parameter> parameters, const Constraints& constraints,
                       const SolverOptions& options) {
  if (constraints.empty()) return least_squares(residuals, count, parameters, options);
  const Reduced reduced = reduce(parameters, constraints);
  Solution s = solve_reduced(residuals, count, reduced, 0, options);
  // The scatter of the data, which sets the weight of a prior, follows from a fit without it.
  const double weight = s.standard_deviation * std::sqrt(s.inflation);
  if (weight > 0 && !reduced.priors.empty())
    s = solve_reduced(residuals, count, reduced, weight, options);
  return restored(std::move(s), count, parameters, reduced);
}

std::size_t free_count(std::span<const Estimate> estimates) {
  return static_cast<std::size_t>(std::ranges::count_if(estimates, &Estimate::free));
}

}  // namespace sinew::identify
