#include "sinew/recording/matlab.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "sinew/config/diagnostics.h"
#include "sinew/host/module.h"
#include "sinew/log/file.h"
#include "sinew/recording/clock.h"
#include "sinew/recording/matlab_bytes.h"
#include "sinew/recording/module/matlab.h"

namespace sinew::recording {

namespace {

struct Matrix {
  std::string name;
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
};

// Holds what is in a file, as the module hands it over.
struct Variables {
  std::vector<Matrix> matrices;
  std::map<std::string, std::string> texts;  // by name
  std::vector<std::string> other;            // "C: a cell array"
};

void take_matrix(void* to, const char* name, std::size_t rows, std::size_t columns,
                 const double* values) {
  Matrix matrix{name, rows, columns, {values, values + rows * columns}};
  if (rows == 1) std::swap(matrix.rows, matrix.columns);  // a vector either way
  static_cast<Variables*>(to)->matrices.push_back(std::move(matrix));
}

void take_text(void* to, const char* name, const char* text) {
  static_cast<Variables*>(to)->texts[name] = text;
}

void take_other(void* to, const char* name, const char* what) {
  // MATLAB keeps the names of some objects where the library does not find them.
  const std::string of = *name ? fmt::format("{}: ", name) : "";
  static_cast<Variables*>(to)->other.push_back(of + what);
}

bool is_level_7_3(const std::string& path) {
  constexpr std::string_view begin = "MATLAB 7.3 MAT-file";
  const log::Mapping file(path);
  return std::string_view(file.bytes()).starts_with(begin);
}

Variables variables_of(const std::string& path) {
  void* const module = host::open_module("sinew_matlab.so");
  using Functions = const SinewMatlab* (*)();
  const auto functions =
      module ? reinterpret_cast<Functions>(host::function_of(module, "sinew_matlab_1")) : nullptr;
  if (!functions)
    config::fail({path, 0, 0}, "", "a MAT file, and a sinew that was built without libmatio",
                 "a build with libmatio-dev, or the recording as CSV",
                 "writetable(…) in MATLAB; or apt-get install libmatio-dev, then cmake --preset "
                 "release && cmake --build --preset all");
  Variables out;
  const SinewMatlabSink sink{&out, take_matrix, take_text, take_other};
  const bool whole = functions()->read(path.c_str(), &sink);
  const bool empty = out.matrices.empty() && out.texts.empty() && out.other.empty();
  const bool of_hdf5 = is_level_7_3(path);
  if (whole && !(empty && of_hdf5)) return out;
  const std::string words = functions()->words();
  if (of_hdf5)
    config::fail({path, 0, 0}, "",
                 "a MAT file of version 7.3 (HDF5) that cannot be read" +
                     (words.empty() ? "" : ": " + words),
                 "a whole one, or version 7", "save('file.mat', '-v7') in MATLAB");
  config::fail({path, 0, 0}, "", words.empty() ? "a MAT file that is damaged" : words,
               "a whole MAT file", "save(…, '-v7') anew");
}

// --- which vector is the clock of which matrix ---

std::string_view last_part(std::string_view name) {
  return name.substr(name.rfind('.') == name.npos ? 0 : name.rfind('.') + 1);
}

std::string_view scope_of(std::string_view name) {
  return name.substr(0, name.rfind('.') == name.npos ? 0 : name.rfind('.'));
}

bool is_clock(const Matrix& m, const std::string& asked) {
  if (m.columns != 1 || m.rows < 2) return false;
  if (!asked.empty()) return m.name == asked || last_part(m.name) == asked;
  for (const std::string_view name : {"time", "Time", "t", "tout", "Zeit", "zeit"})
    if (last_part(m.name) == name) return true;
  return false;
}

bool is_within(std::string_view name, std::string_view scope) {
  return scope.empty() ||
         (name.starts_with(scope) && name.size() > scope.size() && name[scope.size()] == '.');
}

// "log.signals(2).values" is what Simulink calls by a label, or else "log(2)"; "elbow.Data" is
// elbow.
std::string people_name(std::string_view name, const Variables& in) {
  const std::string_view part = last_part(name);
  const std::string scope(scope_of(name));
  const bool values = part == "values" || part == "Values" || part == "data" || part == "Data";
  if (!values || scope.empty()) return std::string(name);
  const std::size_t signals = scope.rfind(".signals");
  if (signals == scope.npos) return scope;
  const auto label = in.texts.find(scope + ".label");
  if (label != in.texts.end() && !label->second.empty()) return label->second;
  return scope.substr(0, signals) + scope.substr(signals + std::strlen(".signals"));
}

// Puts matrices as columns behind their clocks.
class Columns {
 public:
  Columns(Variables in, const ClockSettings& settings, Recorded& out)
      : in_(std::move(in)), settings_(settings), out_(out) {}

  void put() {
    for (const Matrix& m : in_.matrices)
      if (settings_.rate.empty() && is_clock(m, settings_.column)) put_clock(m);
    for (const Matrix& m : in_.matrices) {
      if (is_a_clock_of_ours(m)) continue;
      if (m.rows == 1 && m.columns == 1)
        single_.push_back(m.name);
      else
        put_matrix(m);
    }
    tell();
  }

 private:
  void put_clock(const Matrix& m) {
    const double unit = 1e9 * seconds_per_unit(settings_.unit, out_.file);
    Clock clock{.column = m.name, .time_ns = signals::Times(pages_)};
    for (const double t : m.values) {
      if (!std::isfinite(t) || std::abs(t * unit) > 9e18)
        config::fail({out_.file, 0, 0}, m.name, fmt::format("the time {}", t),
                     "finite times, in s or as clock.unit says");
      clock.time_ns.push_back(std::llround(t * unit));
    }
    out_.clocks.push_back(std::move(clock));
  }

  bool is_a_clock_of_ours(const Matrix& m) const {
    return std::ranges::find(out_.clocks, m.name, &Clock::column) != out_.clocks.end();
  }

  void put_matrix(const Matrix& m) {
    const std::optional<std::size_t> down = clock_for(m, m.rows);
    const std::optional<std::size_t> across = down ? std::nullopt : clock_for(m, m.columns);
    if (!down && !across) {
      other_length_.push_back(fmt::format("{} ({} x {})", m.name, m.rows, m.columns));
      return;
    }
    const std::string name = people_name(m.name, in_);
    const std::size_t count = down ? m.columns : m.rows;
    for (std::size_t k = 0; k < count; ++k) {
      RecordedColumn column{.name = count == 1 ? name : fmt::format("{}({})", name, k + 1),
                            .clock = down ? *down : *across,
                            .values = signals::Column(pages_)};
      for (std::size_t i = 0; i < (down ? m.rows : m.columns); ++i)
        column.values.push_back(down ? m.values[k * m.rows + i] : m.values[i * m.rows + k]);
      out_.columns.push_back(std::move(column));
    }
  }

  // The one nearest to it; with a rate, one that is made.
  std::optional<std::size_t> clock_for(const Matrix& m, std::size_t samples) {
    if (!settings_.rate.empty()) return made_clock(m, samples);
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < out_.clocks.size(); ++i) {
      const Clock& clock = out_.clocks[i];
      const std::string_view scope = scope_of(clock.column);
      if (clock.time_ns.size() != samples || !is_within(m.name, scope)) continue;
      if (!best || scope.size() > scope_of(out_.clocks[*best].column).size()) best = i;
    }
    return best;
  }

  std::optional<std::size_t> made_clock(const Matrix& m, std::size_t samples) {
    if (samples < 2 || samples < std::max(m.rows, m.columns)) return std::nullopt;
    for (std::size_t i = 0; i < out_.clocks.size(); ++i)
      if (out_.clocks[i].time_ns.size() == samples) return i;
    Clock clock{.time_ns = signals::Times(pages_)};
    const double step = 1e9 * period_of_rate(settings_.rate);
    for (std::size_t i = 0; i < samples; ++i)
      clock.time_ns.push_back(std::llround(step * static_cast<double>(i)));
    out_.clocks.push_back(std::move(clock));
    return out_.clocks.size() - 1;
  }

  void tell() {
    if (out_.clocks.empty())
      config::fail({out_.file, 0, 0}, "time",
                   fmt::format("no vector of times among {}", names_of_all()),
                   "time, t or tout, as long as the signals",
                   settings_.column.empty() ? "names.time=NAME, or rate=\"100 Hz\""
                                            : "names.time=NAME of another");
    const auto note = [&](const std::vector<std::string>& names, const char* why) {
      if (!names.empty()) out_.notes.push_back(fmt::format("{}: left out: {}", joined(names), why));
    };
    note(single_, "a single number is no recording");
    note(other_length_, "no vector of times beside it has as many values");
    note(in_.other, "only vectors and matrices of real numbers are read");
  }

  std::string names_of_all() const {
    std::vector<std::string> names;
    for (const Matrix& m : in_.matrices) names.push_back(m.name);
    for (const std::string& name : in_.other) names.push_back(name);
    return names.empty() ? "no variables" : joined(names);
  }

  static std::string joined(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12;
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
      out += (i > 0 ? ", " : "") + names[i];
    return names.size() > most ? fmt::format("{} and {} more", out, names.size() - most) : out;
  }

  Variables in_;
  const ClockSettings& settings_;
  Recorded& out_;
  signals::PageFile pages_ = signals::PageFile::make();
  std::vector<std::string> single_, other_length_;
};

}  // namespace

Recorded read_matlab(const std::string& path, const ClockSettings& clock) {
  {
    const log::Mapping bytes(path);
    check_matlab_bytes(bytes.bytes(), path);
  }
  Recorded out{.file = path, .kind = "MATLAB"};
  Columns(variables_of(path), clock, out).put();
  return out;
}

}  // namespace sinew::recording
