#include "sinew/tune/results/kept.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sinew/tune/table.h"

namespace sinew::tune {

void open_results(const Sweep& s, const std::filesystem::path& file, Options& options,
                  std::optional<Results>& results, const run::Notices& notices) {
  if (file.empty()) return;
  results.emplace(file, asked_of(s));
  options.known = results->rows();
  std::erase_if(options.known, [&](const Row& row) { return !options.share.has(row.point); });
  if (!options.known.empty())
    notices.note(fmt::format("{}: {} of {} points are there", file.string(), options.known.size(),
                             options.share.size(points(s))));
}

void judge(const std::vector<Row>& rows, const Sweep& s, std::size_t points,
           const std::string& kept, bool goes_on, const run::Notices& notices) {
  for (const std::string& text : warnings(rows)) notices.warning(text);
  if (rows.size() < points)
    throw std::runtime_error(
        fmt::format("interrupted: {} of {} points are done{}{}", rows.size(), points,
                    kept.empty() ? "" : " and kept in " + kept,
                    goes_on ? "; the same command goes on with the others" : ""));
  try {
    refuse_empty_columns(rows, s);
  } catch (const std::exception& e) {
    if (kept.empty()) throw;
    throw std::runtime_error(fmt::format("{}\n{}: holds the rows", e.what(), kept));
  }
}

}  // namespace sinew::tune
