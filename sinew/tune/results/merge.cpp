#include "sinew/tune/results/merge.h"

#include <fmt/format.h>

#include <map>

#include "sinew/run/folder/refusal.h"
#include "sinew/tune/results/results.h"

namespace sinew::tune {
namespace {

namespace fs = std::filesystem;

// A row and the file it came from.
struct Origin {
  const fs::path* file;
  Row row;
};

bool same(const Row& a, const Row& b) {
  return a.cells == b.cells && a.ok == b.ok && a.notes == b.notes;
}

[[noreturn]] void refuse_point(const Origin& first, const fs::path& file, const Row& second,
                               const std::vector<Column>& columns) {
  std::size_t i = 0;
  while (i + 1 < columns.size() && first.row.cells[i] == second.cells[i]) ++i;
  run::refuse(
      file, fmt::format("point {} with {} = {}", second.point, columns[i].heading, second.cells[i]),
      fmt::format("{}, as {} has it", first.row.cells[i], first.file->string()),
      "the same program for all shards, and to run one of both files again");
}

class Rows {
 public:
  explicit Rows(const std::vector<Column>& columns) : columns_(columns) {}

  void add(const fs::path& file, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      const auto [at, is_new] = rows_.try_emplace(row.point, Origin{&file, row});
      if (!is_new && !same(at->second.row, row)) refuse_point(at->second, file, row, columns_);
    }
  }

  std::size_t size() const { return rows_.size(); }

  // Those that are not of this file.
  std::vector<Row> besides(const fs::path& file) const {
    std::vector<Row> out;
    for (const auto& [point, origin] : rows_)
      if (origin.file != &file) out.push_back(origin.row);
    return out;
  }

 private:
  const std::vector<Column>& columns_;
  std::map<std::size_t, Origin> rows_;
};

}  // namespace

Merged merge(const std::vector<fs::path>& from, const fs::path& to) {
  std::error_code none;
  for (const fs::path& file : from)
    if (fs::equivalent(file, to, none))
      run::refuse(to, "a file that is merged", "a name for all of them", "another name");

  const Asked asked = read_results(from.front()).asked;
  Results out(to, asked);
  Rows rows(asked.columns);
  rows.add(to, out.rows());
  const std::size_t before = rows.size();
  for (const fs::path& file : from) {
    const HeldStudy held = read_results(file);
    require_same(file, held.asked, asked);
    rows.add(file, held.rows);
  }
  out.add_all(rows.besides(to));
  return {asked.points, rows.size(), rows.size() - before};
}

}  // namespace sinew::tune
