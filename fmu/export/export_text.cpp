// Text and JSON of a new FMU.
#include <fmt/format.h>

#include "fmu/export/export.h"
#include "sinew/json/json.h"

namespace sinew::fmu {

namespace {

Json json_start(const Variable& v) {
  using T = Variable::Type;
  if (v.type == T::boolean) return v.start != 0;
  return v.type == T::integer ? Json(static_cast<int>(v.start)) : Json(v.start);
}

}  // namespace

std::string json_of(const Fmu& made, const std::string& file) {
  Json out{{"file", file},
           {"kind", made.kind},
           {"name", made.name},
           {"model_identifier", made.identifier},
           {"token", made.token}};
  for (std::size_t k = 0; k < made.variables.size(); ++k) {
    const Variable& v = made.variables[k];
    Json entry{{"name", v.name},
               {"value_reference", k},
               {"type", word(v.type)},
               {"causality", word(v.causality)}};
    if (!v.unit.empty()) entry["unit"] = v.unit;
    using C = Variable::Causality;
    if (v.causality == C::parameter || v.causality == C::input) entry["start"] = json_start(v);
    entry["meaning"] = v.doc;
    out["variables"].push_back(entry);
  }
  return out.text(2) + "\n";
}

std::string text_of(const Fmu& made, const std::string& file) {
  using C = Variable::Causality;
  std::string out = fmt::format("{}: {} \"{}\", {:.0f} KB\n", file, made.kind, made.name,
                                static_cast<double>(made.bytes.size()) / 1000);
  const auto row = [&](C causality, const char* title) {
    std::string names;
    int count = 0;
    for (const Variable& v : made.variables)
      if (v.causality == causality && ++count <= 12) names += (count > 1 ? ", " : "") + v.name;
    if (count > 12) names += fmt::format(", … {} in all", count);
    if (count > 0) out += fmt::format("{:<12}{}\n", title, names);
  };
  row(C::input, "inputs");
  row(C::output, "outputs");
  row(C::parameter, "parameters");
  return out;
}

}  // namespace sinew::fmu
