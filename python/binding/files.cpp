// python/binding/files.cpp - files: an older format becomes today's, and the keys that they can
// have.
#include "sinew/files/key_text.h"
#include "sinew/files/keys.h"
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

py::object keys(const py::args& words, const std::string& kind) {
  std::vector<std::string> texts;
  for (const py::handle& word : words) {
    if (!py::isinstance<py::str>(word)) throw py::type_error("keys: expected texts as words");
    texts.push_back(word.cast<std::string>());
  }
  return py::module_::import("json").attr("loads")(files::json_of(files::find_keys(texts, kind)));
}

py::object key_schema(const std::string& kind) {
  return py::module_::import("json").attr("loads")(files::schema_of(kind));
}

}  // namespace

void bind_files(py::module_& m) {
  m.def("migrate", &migrate, py::arg("path"), py::kw_only(), py::arg("folder") = py::none(),
        py::arg("write") = true,
        "Brings a TOML file of an older format to today's; comments and layout stay. The old file\n"
        "is kept as FILE.bak, or the new one goes into `folder`; nothing is overwritten. Returns\n"
        "what it was and is, each change with its line, and where new and old file are. Without\n"
        "`write` it only tells. Raises InputError.");
  m.def("keys", &keys, py::kw_only(), py::arg("kind") = "",
        "Returns the keys of files that have all of the words in their path, description or\n"
        "choices: a dict each, with `kind`, `key`, `type`, `unit`, `default`, `doc` and more. A\n"
        "word with a dot is a key or how one begins, with your names in it: joint.hip.damping.\n"
        "`kind` is that of a file: robot, actuator, valves, wiring, experiment, rig, plan, tuning\n"
        "or any. Raises InputError, with the nearest key, where there is none.");
  m.def("key_schema", &key_schema, py::arg("kind"),
        "Returns the JSON schema of files of that kind, for editors that complete TOML.");
}

}  // namespace sinew::python
