#include "fmu/export/model_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fmu/slave/description.h"
#include "sinew/report/page/page.h"
#include "sinew/units/unit.h"

namespace sinew::fmu {

namespace {

using Causality = Variable::Causality;
using Type = Variable::Type;
using report::escaped;

constexpr const char* xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

// Returns ` name="value"`; nothing for an empty text or a number that is not finite.
std::string attribute(std::string_view name, std::string_view value) {
  return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, escaped(value));
}
std::string attribute(std::string_view name, double value) {
  return std::isfinite(value) ? attribute(name, std::string_view(text_of(value))) : "";
}

// Returns a field's unit without the reference of a pressure; empty for a plain number.
std::string plain_unit(std::string_view unit) {
  for (const std::string_view word : {" abs", " gauge", " diff"})
    if (unit.ends_with(word)) unit.remove_suffix(word.size());
  return unit == "1" ? "" : std::string(unit);
}

bool has_unit(const Variable& v) { return v.type == Type::real && !plain_unit(v.unit).empty(); }

// Returns the unit in SI base units: a volt is kg m2/(s3 A), and a count is a plain number.
std::string base_unit(const std::string& unit) {
  const units::UnitReading read = units::read_unit(unit);
  if (!read.ok) return "";
  const units::Dimension& d = read.unit.dimension;
  const auto power = [](std::string_view name, int n) {
    return n == 0 ? "" : fmt::format(" {}=\"{}\"", name, n);
  };
  const double factor = read.unit.numerator / read.unit.denominator;
  return "<BaseUnit" + power("kg", d.mass + d.voltage) + power("m", d.length + 2 * d.voltage) +
         power("s", d.time - 3 * d.voltage) + power("A", d.current - d.voltage) +
         power("K", d.temperature) + power("rad", d.angle) +
         (factor == 1 ? "" : attribute("factor", factor)) + "/>";
}

// Display units used in laboratories: value in the unit = factor x value in SI.
struct Display {
  std::string_view si, name;
};
constexpr std::array displays{Display{"Pa", "psi"},    Display{"Pa", "bar"}, Display{"rad", "deg"},
                              Display{"m", "in"},      Display{"m", "mm"},   Display{"N", "lbf"},
                              Display{"s", "ms"},      Display{"kg", "g"},   Display{"m3", "mL"},
                              Display{"N m", "lbf in"}};

std::string unit_definitions(const std::vector<Variable>& variables) {
  std::vector<std::string> names;
  for (const Variable& v : variables)
    if (has_unit(v)) names.push_back(plain_unit(v.unit));
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string out = "  <UnitDefinitions>\n";
  for (const std::string& name : names) {
    out += "    <Unit" + attribute("name", std::string_view(name)) + ">" + base_unit(name);
    for (const Display& d : displays)
      if (d.si == name)
        out += fmt::format("<DisplayUnit name=\"{}\"{}/>", d.name,
                           attribute("factor", units::read_unit(d.name).unit.from_si(1)));
    out += "</Unit>\n";
  }
  return names.empty() ? "" : out + "  </UnitDefinitions>\n";
}

std::string log_categories(std::string_view description) {
  return fmt::format(
      "  <LogCategories>\n"
      "    <Category name=\"logStatusError\"{0}=\"why a call was refused or has failed\"/>\n"
      "    <Category name=\"logStatusDiscard\"{0}=\"what could not be done and may be tried "
      "otherwise\"/>\n"
      "    <Category name=\"logEvents\"{0}=\"what happens\"/>\n"
      "  </LogCategories>\n",
      std::string(" ") + std::string(description));
}

std::string experiment_of(const ModelDescription& model) {
  return "  <DefaultExperiment startTime=\"0\"" + attribute("stopTime", model.stop_time) +
         attribute("stepSize", model.step) + "/>\n";
}

std::string_view variability_word(const Variable& v) {
  if (v.causality == Causality::parameter) return "fixed";
  return v.type == Type::real && !v.discrete ? "continuous" : "discrete";
}

bool has_start(const Variable& v) {
  return v.causality == Causality::parameter || v.causality == Causality::input;
}

std::string start_of(const Variable& v) {
  if (!has_start(v)) return "";
  if (v.type == Type::boolean) return v.start != 0 ? " start=\"true\"" : " start=\"false\"";
  return attribute("start", v.start);
}

// Returns the attributes that both versions have after name, reference and description.
std::string value_attributes(const Variable& v) {
  std::string out;
  if (has_unit(v)) out += attribute("unit", std::string_view(plain_unit(v.unit)));
  if (v.type != Type::boolean) out += attribute("min", v.min) + attribute("max", v.max);
  return out + start_of(v);
}

std::string numbers(const std::vector<int>& of, int more) {
  std::string out;
  for (const int k : of) out += (out.empty() ? "" : " ") + std::to_string(k + more);
  return out;
}

// Returns "0 to 1" or "at least 0"; empty if there are no limits.
std::string range_of(const Variable& v) {
  const bool least = std::isfinite(v.min), most = std::isfinite(v.max);
  if (v.type == Type::boolean || (!least && !most)) return "";
  if (!most) return "at least " + text_of(v.min);
  return (least ? text_of(v.min) + " to " : "at most ") + text_of(v.max);
}

std::vector<std::size_t> places_of(const ModelDescription& model, Causality causality) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < model.variables.size(); ++k)
    if (model.variables[k].causality == causality) out.push_back(k);
  return out;
}

std::string head(const ModelDescription& model, std::string_view version, std::string_view token) {
  return xml_head + ("<fmiModelDescription" + attribute("fmiVersion", version)) +
         attribute("modelName", std::string_view(model.name)) +
         attribute(token, std::string_view(model.token)) +
         attribute("description", std::string_view(model.description)) +
         attribute("generationTool", std::string_view("Sinew " + model.version)) +
         " variableNamingConvention=\"structured\">\n";
}

// Returns the attributes before the values: name, reference, meaning, causality and variability.
std::string named(const Variable& v, std::size_t place) {
  return attribute("name", std::string_view(v.name)) +
         fmt::format(" valueReference=\"{}\"", place) +
         attribute("description", std::string_view(v.doc)) +
         attribute("causality", std::string_view(word(v.causality))) +
         attribute("variability", variability_word(v)) +
         (v.causality == Causality::parameter ? " initial=\"exact\"" : "");
}

}  // namespace

std::string fmi2_description(const ModelDescription& model) {
  const bool interpolates =
      std::ranges::any_of(model.variables, [](const Variable& v) { return v.rate > 0; });
  std::string out = head(model, "2.0", "guid");
  out += "  <CoSimulation" + attribute("modelIdentifier", std::string_view(model.identifier)) +
         " canHandleVariableCommunicationStepSize=\"true\" canGetAndSetFMUstate=\"true\""
         " canSerializeFMUstate=\"true\" canNotUseMemoryManagementFunctions=\"true\"" +
         (interpolates ? " canInterpolateInputs=\"true\"" : "");
  out += model.sources ? ">\n    <SourceFiles><File name=\"fmi2.cpp\"/></SourceFiles>\n"
                         "  </CoSimulation>\n"
                       : "/>\n";
  out += unit_definitions(model.variables) + log_categories("description") + experiment_of(model);
  out += "  <ModelVariables>\n";
  for (std::size_t k = 0; k < model.variables.size(); ++k) {
    const Variable& v = model.variables[k];
    const std::string_view element =
        v.type == Type::real ? "Real" : (v.type == Type::integer ? "Integer" : "Boolean");
    out += fmt::format("    <ScalarVariable{}><{}{}/></ScalarVariable>\n", named(v, k), element,
                       value_attributes(v));
  }
  out += "  </ModelVariables>\n  <ModelStructure>\n";
  // Indices count from 1.
  std::string unknowns;
  for (const std::size_t k : places_of(model, Causality::output))
    unknowns += fmt::format("      <Unknown index=\"{}\" dependencies=\"{}\"/>\n", k + 1,
                            numbers(model.variables[k].follows, 1));
  if (!unknowns.empty()) {
    out += "    <Outputs>\n" + unknowns + "    </Outputs>\n    <InitialUnknowns>\n";
    for (const std::size_t k : places_of(model, Causality::output))
      out += fmt::format("      <Unknown index=\"{}\"/>\n", k + 1);
    out += "    </InitialUnknowns>\n";
  }
  return out + "  </ModelStructure>\n</fmiModelDescription>\n";
}

std::string fmi3_description(const ModelDescription& model) {
  std::string out = head(model, "3.0", "instantiationToken");
  out += "  <CoSimulation" + attribute("modelIdentifier", std::string_view(model.identifier)) +
         " canHandleVariableCommunicationStepSize=\"true\" canGetAndSetFMUState=\"true\""
         " canSerializeFMUState=\"true\"/>\n";
  out += unit_definitions(model.variables) + log_categories("description") + experiment_of(model);
  out += "  <ModelVariables>\n";
  for (std::size_t k = 0; k < model.variables.size(); ++k) {
    const Variable& v = model.variables[k];
    const std::string_view element =
        v.type == Type::real ? "Float64" : (v.type == Type::integer ? "Int32" : "Boolean");
    out += fmt::format("    <{}{}{}/>\n", element, named(v, k), value_attributes(v));
  }
  out += "  </ModelVariables>\n  <ModelStructure>\n";
  const std::vector<std::size_t> outputs = places_of(model, Causality::output);
  for (const std::size_t k : outputs)
    out += fmt::format("    <Output valueReference=\"{}\" dependencies=\"{}\"/>\n", k,
                       numbers(model.variables[k].follows, 0));
  for (const std::size_t k : outputs)
    out += fmt::format("    <InitialUnknown valueReference=\"{}\"/>\n", k);
  return out + "  </ModelStructure>\n</fmiModelDescription>\n";
}

std::string build_description(const ModelDescription& model) {
  return std::string(xml_head) + "<fmiBuildDescription fmiVersion=\"3.0\">\n  <BuildConfiguration" +
         attribute("modelIdentifier", std::string_view(model.identifier)) +
         ">\n    <SourceFileSet language=\"C++20\" compiler=\"gcc\" "
         "compilerOptions=\"-ffp-contract=off\">\n"
         "      <SourceFile name=\"fmi3.cpp\"/>\n      <IncludeDirectory name=\".\"/>\n"
         "    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n";
}

std::string variables_page(const ModelDescription& model) {
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>body{{font:16px/1.5 sans-serif;margin:2em auto;max-width:70em;padding:0 1em}}"
      "td,th{{text-align:left;padding:.2em .8em .2em 0;vertical-align:top}}"
      "th{{border-bottom:1px solid}}</style>\n"
      "<h1>{0}</h1>\n<p>{1}.</p>\n<p>Made by Sinew {2}. Units are SI; times in seconds.</p>\n",
      escaped(model.name), escaped(model.description), escaped(model.version));
  for (const Causality c : {Causality::input, Causality::output, Causality::parameter}) {
    const std::vector<std::size_t> places = places_of(model, c);
    if (places.empty()) continue;
    out +=
        fmt::format("<h2>{}s</h2>\n<table><tr><th>name<th>unit<th>start<th>range<th>meaning</tr>\n",
                    c == Causality::input    ? "Input"
                    : c == Causality::output ? "Output"
                                             : "Parameter");
    for (const std::size_t k : places) {
      const Variable& v = model.variables[k];
      const std::string unit = v.unit == "1" ? "" : v.unit;
      out +=
          fmt::format("<tr><td>{}<td>{}<td>{}<td>{}<td>{}</tr>\n", escaped(v.name), escaped(unit),
                      has_start(v) ? text_of(v.start) : "", range_of(v), escaped(v.doc));
    }
    out += "</table>\n";
  }
  return out + "</html>\n";
}

}  // namespace sinew::fmu
