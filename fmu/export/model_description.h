// fmu/export/model_description.h - modelDescription.xml of FMI 2.0 and 3.0, and a page of the
// variables for people.
#pragma once

#include <string>
#include <vector>

#include "fmu/slave/variable.h"

namespace sinew::fmu {

// Holds what a description says of a model.
struct Described {
  std::string name;        // of the model, for people
  std::string identifier;  // a C identifier: the binary's file name
  std::string token;       // that the binary expects
  std::string description;
  std::string version;              // of Sinew
  double stop_time = 1;             // [s]
  double step = 1e-3;               // that suits it [s]
  bool sources = false;             // does the FMU have them?
  std::vector<Variable> variables;  // the time first
};

// Return modelDescription.xml.
std::string fmi2_description(const Described& model);
std::string fmi3_description(const Described& model);

// sources/buildDescription.xml, which FMI 3.0 asks for beside sources.
std::string build_description(const Described& model);

// documentation/index.html: every variable with its unit, start, range and meaning.
std::string variables_page(const Described& model);

}  // namespace sinew::fmu
