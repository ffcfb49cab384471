// A log that is read has complete series in ascending time; written and read again it is the same.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "sinew/log/reader.h"
#include "sinew/log/writer.h"
#include "tests/fuzz/law.h"

namespace sinew::fuzz {
namespace {

// A file in memory, by the name under which it can be opened.
std::filesystem::path file_of(std::string_view input) {
  static const int file = memfd_create("log.mcap", 0);
  law(file >= 0 && ftruncate(file, 0) == 0, "memory for a file");
  const ssize_t written = pwrite(file, input.data(), input.size(), 0);
  law(written == static_cast<ssize_t>(input.size()), "memory for a file");
  return "/proc/self/fd/" + std::to_string(file);
}

void law_of_series(const signals::Series& s) {
  law(std::ranges::is_sorted(s.time_ns), "times ascend: " + s.topic.name);
  law(s.columns.size() == s.topic.fields.size(), "a column for each field: " + s.topic.name);
  for (const signals::Column& column : s.columns)
    law(column.size() == s.time_ns.size(), "a value for each time: " + s.topic.name);
}

// The log's writer accepts a table whose topics could be those of a run.
bool can_be_written(const signals::Table& table) {
  std::set<std::string> names;
  std::size_t samples = 0;
  for (const signals::Series& s : table.series) {
    const std::size_t fields = s.topic.fields.size();
    if (fields < 1 || fields > 4 || !names.insert(s.topic.name).second) return false;
    if (!s.time_ns.empty() && s.time_ns.front() < 0) return false;
    samples += s.time_ns.size();
  }
  return !table.series.empty() && samples <= 1000;
}

bool same(double a, double b) { return a == b || (!std::isfinite(a) && std::isnan(b)); }

void law_of_writing(const signals::Table& table) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("sinew-fuzz-" + std::to_string(getpid()) + ".mcap");
  std::vector<signals::Topic> topics;
  for (const signals::Series& s : table.series) topics.push_back(s.topic);
  try {
    log::Writer writer(file, topics);
    for (std::size_t t = 0; t < table.series.size(); ++t) {
      const signals::Series& s = table.series[t];
      for (std::size_t i = 0; i < s.time_ns.size(); ++i) {
        std::vector<double> values;
        for (const signals::Column& column : s.columns) values.push_back(column[i]);
        law(writer.push(static_cast<std::uint16_t>(t), s.time_ns[i], values), "a sample is taken");
      }
    }
    writer.finish();
  } catch (const log::Error& error) {
    std::filesystem::remove(file);
    return law(
        std::string(error.what()).find("not UTF-8") != std::string::npos,
        std::string("what is read is written, but for names that are no text: ") + error.what());
  }
  const signals::Table again = log::read(file);
  std::filesystem::remove(file);
  law(again.complete && again.series.size() == table.series.size(), "what is written can be read");
  for (std::size_t t = 0; t < table.series.size(); ++t) {
    const signals::Series &a = table.series[t], &b = again.series[t];
    law(a.topic.name == b.topic.name && a.time_ns == b.time_ns, "times are kept: " + a.topic.name);
    for (std::size_t c = 0; c < a.columns.size(); ++c)
      law(std::ranges::equal(a.columns[c], b.columns[c], same), "values are kept: " + a.topic.name);
  }
}

}  // namespace

void mcap(std::string_view input) {
  const std::filesystem::path file = file_of(input);
  try {
    (void)log::read_metadata(file);
    const signals::Table table = log::read(file);
    for (const signals::Series& s : table.series) law_of_series(s);
    if (can_be_written(table)) law_of_writing(table);
  } catch (const log::Error& error) {
    law(std::string(error.what()).starts_with(file.string()),
        std::string("a refusal names the file: ") + error.what());
  }
}

}  // namespace sinew::fuzz
