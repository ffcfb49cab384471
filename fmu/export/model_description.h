// fmu/export/model_description.h - modelDescription.xml of FMI 2.0 and 3.0, and an HTML page of the
// variables.
#pragma once

#include <string>
#include <vector>

#include "fmu/slave/variable.h"

namespace sinew::fmu {

// Contents of a model description.
struct ModelDescription {
  std::string name;        // display name of the model
  std::string identifier;  // a C identifier: the binary's file name
  std::string token;       // token that the binary expects
  std::string description;
  std::string version;              // version of Sinew
  double stop_time = 1;             // [s]
  double step = 1e-3;               // suitable step [s]
  bool sources = false;             // whether the FMU contains sources
  std::vector<Variable> variables;  // variables, the time first
};

// Return modelDescription.xml.
std::string fmi2_description(const ModelDescription& model);
std::string fmi3_description(const ModelDescription& model);

// Returns sources/buildDescription.xml, which FMI 3.0 requires together with sources.
std::string build_description(const ModelDescription& model);

// Returns documentation/index.html: each variable with its unit, start, range and meaning.
std::string variables_page(const ModelDescription& model);

}  // namespace sinew::fmu
