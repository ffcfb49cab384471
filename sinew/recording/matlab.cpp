#include "sinew/recording/matlab.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "sinew/config/diagnostics.h"
#include "sinew/host/module.h"
#include "sinew/log/file.h"
#include "sinew/recording/clock.h"
#include "sinew/recording/module/matlab.h"

namespace sinew::recording {

namespace {

// --- checks of a MATLAB file before libmatio reads it ---

constexpr std::size_t header = 128;  // size of the header of level 5 [B]

std::uint32_t word(std::string_view bytes, std::size_t at, bool big) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i)
    out |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + (big ? 3 - i : i)]))
           << (8 * i);
  return out;
}

[[noreturn]] void cut_off(const std::string& path, std::size_t size) {
  config::fail({path, 0, 0}, "",
               fmt::format("a MAT file that ends within a variable, after {} bytes", size),
               "a whole one", "to copy it again, or to save it again");
}

// Checks that no element extends past the end. An element is a type, a length and the data;
// elements follow each other. Within a matrix each begins at a multiple of eight bytes, and data of
// up to four bytes are stored next to their type. A matrix consists of elements, which may be
// matrices: the fields of a struct.
void check_elements(std::string_view bytes, bool within, bool big, const std::string& path,
                    std::size_t size) {
  constexpr std::uint32_t matrix = 14;
  while (!bytes.empty()) {
    if (bytes.size() < 8) cut_off(path, size);
    const std::uint32_t type = word(bytes, 0, big);
    const bool small = within && type >> 16 != 0;
    const std::size_t length = small ? 0 : word(bytes, 4, big);
    const std::size_t padded = within ? (length + 7) / 8 * 8 : length;
    if (padded > bytes.size() - 8) cut_off(path, size);
    if (!small && type == matrix) check_elements(bytes.substr(8, length), true, big, path, size);
    bytes.remove_prefix(8 + padded);
  }
}

void check_level_5(std::string_view bytes, const std::string& path) {
  if (bytes.size() < header) cut_off(path, bytes.size());
  check_elements(bytes.substr(header), false, bytes.substr(126, 2) == "MI", path, bytes.size());
}

// Returns whether the bytes are a MAT file of level 4, which has no signature: its numbers must be
// plausible. A variable has five words (type, rows, columns, whether it is complex, length of the
// name), then the name, then the numbers.
bool is_level_4(std::string_view bytes) {
  constexpr std::size_t head = 20;
  if (bytes.size() < head) return false;
  const std::uint32_t little = word(bytes, 0, false),
                      type = little > 9999 ? word(bytes, 0, true) : little;
  const bool big = little > 9999;
  const std::uint32_t rows = word(bytes, 4, big), columns = word(bytes, 8, big);
  const std::uint32_t complex = word(bytes, 12, big), letters = word(bytes, 16, big);
  const std::uint32_t number = type / 10 % 10, kind = type % 10;
  const std::size_t sizes[] = {8, 4, 4, 2, 2, 1};
  if (type > 4059 || type / 100 % 10 != 0 || number > 5 || kind > 2) return false;
  if (complex > 1 || letters < 2 || letters > 256) return false;
  if (bytes.size() < head + letters || bytes[head + letters - 1] != '\0') return false;
  const double values = static_cast<double>(rows) * columns * (complex + 1);
  return values * static_cast<double>(sizes[number]) <=
         static_cast<double>(bytes.size() - head - letters);
}

// Throws config::Error for a file that is not a MAT file or ends within a variable.
void check_matlab_bytes(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("MATLAB 5.0 MAT-file")) return check_level_5(bytes, path);
  if (is_matlab(bytes) || is_level_4(bytes)) return;
  if (bytes.starts_with("\x89HDF"))
    config::fail({path, 0, 0}, "", "an HDF5 file, without MATLAB's words before it",
                 "a MAT file of level 4, 5 or 7.3", "save('file.mat', '-v7') in MATLAB");
  std::string begin;
  for (const char c : bytes.substr(0, 24)) begin += c >= ' ' && c <= '~' ? c : '.';
  config::fail({path, 0, 0}, "",
               fmt::format("a file that begins with {}", config::in_quotes(begin)),
               "a MAT file of level 4, 5 or 7.3",
               "a name with the ending of what it is, .csv for a table of text");
}

struct Matrix {
  std::string name;
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
};

// Contents of a file, as received from the module.
struct Variables {
  std::vector<Matrix> matrices;
  std::map<std::string, std::string> texts;  // keyed by name
  std::vector<std::string> other;            // "C: a cell array"
};

void take_matrix(void* to, const char* name, std::size_t rows, std::size_t columns,
                 const double* values) {
  Matrix matrix{name, rows, columns, {values, values + rows * columns}};
  if (rows == 1) std::swap(matrix.rows, matrix.columns);  // a row vector becomes a column
  static_cast<Variables*>(to)->matrices.push_back(std::move(matrix));
}

void take_text(void* to, const char* name, const char* text) {
  static_cast<Variables*>(to)->texts[name] = text;
}

void take_other(void* to, const char* name, const char* what) {
  // Some objects have their names where the library does not find them.
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
               "a whole MAT file", "save(…, '-v7') again");
}

// --- matching of matrices to time vectors ---

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

// Returns a readable name: a Simulink signal "log.signals(2).values" has its label or else
// "log(2)"; "elbow.Data" is elbow.
std::string readable_name(std::string_view name, const Variables& in) {
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

// Returns the seconds in one unit of the clock.
double seconds_per_unit(const std::string& unit, const std::string& file) {
  if (unit.empty()) return 1;
  const units::Parsed one = units::parse_quantity("1 " + unit, "s");
  if (!one.mistake) return one.si;
  config::fail({file, 0, 0}, "clock.unit", config::in_quotes(unit), "a unit of time", "\"ms\"");
}

// Adds matrices as columns, each with its clock.
class Columns {
 public:
  Columns(Variables in, const ClockMapping& settings, Recorded& out)
      : in_(std::move(in)), settings_(settings), out_(out) {}

  void put() {
    for (const Matrix& m : in_.matrices)
      if (settings_.rate.empty() && is_clock(m, settings_.column)) put_clock(m);
    for (const Matrix& m : in_.matrices) {
      if (is_used_clock(m)) continue;
      if (m.rows == 1 && m.columns == 1)
        single_.push_back(m.name);
      else
        put_matrix(m);
    }
    check_and_add_notes();
  }

 private:
  void put_clock(const Matrix& m) {
    const double unit = 1e9 * seconds_per_unit(settings_.unit, out_.file);
    Clock clock{.column = m.name, .time_ns = signals::Times(pages_)};
    for (const double t : m.values) {
      if (!std::isfinite(t) || std::abs(t * unit) > 9e18)
        config::fail({out_.file, 0, 0}, m.name, fmt::format("the time {}", t),
                     "finite times, in s or in clock.unit");
      clock.time_ns.push_back(std::llround(t * unit));
    }
    out_.clocks.push_back(std::move(clock));
  }

  bool is_used_clock(const Matrix& m) const {
    return std::ranges::find(out_.clocks, m.name, &Clock::column) != out_.clocks.end();
  }

  void put_matrix(const Matrix& m) {
    const std::optional<std::size_t> down = clock_for(m, m.rows);
    const std::optional<std::size_t> across = down ? std::nullopt : clock_for(m, m.columns);
    if (!down && !across) {
      other_length_.push_back(fmt::format("{} ({} x {})", m.name, m.rows, m.columns));
      return;
    }
    const std::string name = readable_name(m.name, in_);
    const std::size_t count = down ? m.columns : m.rows;
    for (std::size_t k = 0; k < count; ++k) {
      RecordedColumn column{{.name = count == 1 ? name : fmt::format("{}({})", name, k + 1)},
                            down ? *down : *across,
                            signals::Column(pages_)};
      for (std::size_t i = 0; i < (down ? m.rows : m.columns); ++i)
        column.values.push_back(down ? m.values[k * m.rows + i] : m.values[i * m.rows + k]);
      out_.columns.push_back(std::move(column));
    }
  }

  // Returns the clock in the nearest enclosing struct; with a rate, one that is made for it.
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

  void check_and_add_notes() {
    if (out_.clocks.empty())
      config::fail({out_.file, 0, 0}, "time",
                   fmt::format("no vector of times among {}", names_of_all()),
                   "time, t or tout, as long as the signals",
                   settings_.column.empty() ? "names.time=NAME, or rate=\"100 Hz\""
                                            : "names.time=NAME of another");
    const auto note = [&](const std::vector<std::string>& names, const char* why) {
      if (!names.empty()) out_.notes.push_back(fmt::format("{}: left out: {}", joined(names), why));
    };
    note(single_, "a single number is not a recording");
    note(other_length_, "no vector of times has as many values");
    note(in_.other, "only vectors and matrices of real numbers are read");
  }

  std::string names_of_all() const {
    std::vector<std::string> names;
    for (const Matrix& m : in_.matrices) names.push_back(m.name);
    for (const std::string& name : in_.other) names.push_back(name);
    return names.empty() ? "no variables" : joined(names);
  }

  static std::string joined(const std::vector<std::string>& names) {
    return config::listed(names, 12);
  }

  Variables in_;
  const ClockMapping& settings_;
  Recorded& out_;
  signals::PageFile pages_ = signals::PageFile::make();
  std::vector<std::string> single_, other_length_;
};

}  // namespace

bool is_matlab(std::string_view bytes) {
  return bytes.starts_with("MATLAB 5.0 MAT-file") || bytes.starts_with("MATLAB 7.3 MAT-file");
}

Recorded read_matlab(const std::string& path, const ClockMapping& clock) {
  {
    const log::Mapping bytes(path);
    check_matlab_bytes(bytes.bytes(), path);
  }
  Recorded out{.file = path, .kind = "MATLAB"};
  Columns(variables_of(path), clock, out).put();
  return out;
}

}  // namespace sinew::recording
