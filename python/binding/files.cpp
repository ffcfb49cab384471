// python/binding/files.cpp - files: an older format becomes today's.
#include "sinew/files/migrate.h"

#include <pybind11/stl.h>

#include "python/binding/bind.h"

namespace sinew::python {

namespace {

py::dict migrate(const py::object& path, const py::object& folder, bool write) {
  files::MigrateOptions options{.write = write};
  if (!folder.is_none()) options.folder = path_of(folder);
  const files::Migration done = files::migrate(path_of(path), options);
  py::dict out;
  out["file"] = done.file;
  out["was"] = done.was;
  out["is"] = done.is;
  out["changes"] = done.changes;
  out["written"] = done.written;
  out["kept"] = done.kept;
  return out;
}

}  // namespace

void bind_files(py::module_& m) {
  m.def("migrate", &migrate, py::arg("path"), py::kw_only(), py::arg("folder") = py::none(),
        py::arg("write") = true,
        "Brings a TOML file of an older format to today's; comments and layout stay. The old file\n"
        "is kept as FILE.bak, or the new one goes into `folder`; nothing is overwritten. Returns\n"
        "what it was and is, each change with its line, and where new and old file are. Without\n"
        "`write` it only tells. Raises InputError.");
}

}  // namespace sinew::python
