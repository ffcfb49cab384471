#include "sinew/recording/recorded.h"

namespace sinew::recording {

const RecordedColumn* Recorded::find(std::string_view name) const {
  const RecordedColumn* only = nullptr;
  int ends = 0;
  for (const RecordedColumn& column : columns) {
    if (column.name == name) return &column;
    if (name.empty() || column.name.size() <= name.size() || !column.name.ends_with(name)) continue;
    const char before = column.name[column.name.size() - name.size() - 1];
    if (before != '.' && before != '/') continue;
    only = &column;
    ++ends;
  }
  return ends == 1 ? only : nullptr;
}

}  // namespace sinew::recording
