// config/write/writer.h - visitor that writes structs as TOML, in the namespace that Reader reads.
//
//   config::Writer writer(&reader.origins());
//   writer.format("experiment");
//   fields(writer, robot);
//   file << writer.text();
//
// Quantities are in SI with the digits that read back to the same bits; with origins, for human
// readers, in the unit that makes them short (units/quantity.h). A number that is not finite means
// "not set" and is left out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/units/each_field.h"

namespace sinew::config {

class Writer : public units::EachField {
 public:
  // With origins, each value is written with its source, fit, guess, range and uncertainty.
  explicit Writer(const Origins* origins = nullptr)
      : EachField([this](const units::VisitedField& f) { put(f); }), origins_(origins) {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void format(std::string_view kind);  // format = "sinew.<kind>/1"

  // Returns the TOML of the visited fields.
  std::string text() const;
  using EachField::text;
  // Returns the tree so far; it is complete after the outermost fields() has returned.
  const Node& root() const { return root_; }

 private:
  void put(const units::VisitedField& f);
  void enter(const units::VisitedField& f, Node::Kind kind);
  Node value_of(const units::VisitedField& f) const;

  const Origins* origins_;
  Node root_;
  std::vector<Node*> open_{&root_};  // the tables from the root to the one that is visited
};

// Returns a tree as TOML: values first, then tables under their headers.
std::string to_toml(const Node& root);

// Texts in TOML.

// Returns the text in double quotes. TOML is UTF-8: invalid bytes are replaced.
std::string toml_string(std::string_view text);

}  // namespace sinew::config
