// python/binding/files.cpp - files: listing, creation of new ones, migration from older formats,
// and their keys.
#include "sinew/files/key_text.h"
#include "sinew/files/keys.h"
#include "sinew/files/list.h"
#include "sinew/files/migrate.h"
#include "sinew/files/new_file.h"

#include <pybind11/stl.h>

#include "python/binding/bind.h"

namespace sinew::python {

namespace {

py::dict migrate(const py::object& path, const py::object& folder, bool write) {
  files::MigrateOptions options{.write = write};
  options.folder = path_or_none(folder);
  const files::Migration done = files::migrate(path_of(path), options);
  py::dict out;
  out["file"] = path_text(done.file);
  out["was"] = done.was;
  out["is"] = done.is;
  out["changes"] = done.changes;
  out["written"] = write ? done.written : "";
  out["kept"] = write ? done.kept : "";
  return out;
}

py::object keys(const py::args& words, const std::string& kind) {
  std::vector<std::string> texts;
  for (const py::handle& word : words) {
    if (!py::isinstance<py::str>(word)) throw py::type_error("keys: expected texts as words");
    texts.push_back(word.cast<std::string>());
  }
  return parsed(files::json_of(files::find_keys(texts, kind)));
}

py::object key_schema(const std::string& kind) { return parsed(files::schema_of(kind)); }

py::list list_files(const std::string& kind, const py::object& folder) {
  const std::string here = folder.is_none() ? "." : path_of(folder);
  const files::Listing found = files::list(kind, here);
  py::list out;
  for (const files::Listed& one : found.files) {
    py::dict row;
    row["kind"] = one.kind;
    row["path"] = path_text(one.path);
    row["title"] = one.title;
    row["problem"] = one.problem;
    row["shipped"] = one.shipped;
    out.append(row);
  }
  return out;
}

std::vector<std::string> new_file(const std::string& kind, const std::string& name,
                                  const py::object& folder, const py::object& of,
                                  const py::object& actuator, bool metric) {
  files::NewOptions options{.metric = metric};
  options.folder = path_or_none(folder);
  options.of = path_or_none(of);
  options.actuator = path_or_none(actuator);
  return files::write_new(kind, name, options).files;
}

}  // namespace

void bind_files(py::module_& m) {
  m.def("migrate", &migrate, py::arg("path"), py::kw_only(), py::arg("folder") = py::none(),
        py::arg("write") = true,
        "Brings a TOML file of an older format to today's; comments and layout stay. The old file\n"
        "is kept as FILE.bak, or the new one goes into `folder`; nothing is overwritten. Returns\n"
        "what it was and is, each change with its line, and where new and old file are. Without\n"
        "`write` it only reports, and names no file. Raises InputError.");
  m.def("keys", &keys, py::kw_only(), py::arg("kind") = "",
        "Returns the keys of files that have all of the words in their path, description or\n"
        "choices: a dict each, with `kind`, `key`, `type`, `unit`, `default`, `doc` and more. A\n"
        "word with a dot is a key or how one begins, with your names in it: joint.hip.damping.\n"
        "`kind` is that of a file: robot, actuator, valves, wiring, experiment, rig, plan, tuning\n"
        "or any. Raises InputError, with the nearest key, if the key is unknown.");
  m.def("key_schema", &key_schema, py::arg("kind"),
        "Returns the JSON schema of files of that kind, for editors that complete TOML.");
  m.def(
      "list_files", &list_files, py::arg("kind") = "", py::kw_only(),
      py::arg("folder") = py::none(),
      "Returns the robots, experiments, rigs, studies, valves and examples that come with Sinew\n"
      "and that are in `folder`, this one without it: a dict each, with `kind`, `path`, `title`,\n"
      "`problem` (why it cannot be read) and `shipped`. `kind` is one of these words, or all.\n"
      "Raises InputError.");
  m.def(
      "new_file", &new_file, py::arg("kind"), py::arg("name"), py::kw_only(),
      py::arg("folder") = py::none(), py::arg("of") = py::none(), py::arg("actuator") = py::none(),
      py::arg("metric") = false,
      "Writes a commented file to begin with, valid as written, and returns the paths of what\n"
      "was written, the requested one first. `kind` is robot, actuator, valves,\n"
      "experiment, plan, rig, tuning or mapping; `of` the file that it is about; `actuator` that\n"
      "of a robot's muscles; `metric` has mm, N and bar in place of in, lbf and psi. Nothing is\n"
      "overwritten. Raises InputError.");
}

}  // namespace sinew::python
