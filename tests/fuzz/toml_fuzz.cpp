// A TOML file that is read, written and read again has the same keys and values in it.
#include <cmath>

#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "tests/fuzz/law.h"

namespace sinew::fuzz {
namespace {

using config::Node;

bool same_value(const Node& a, const Node& b) {
  switch (a.kind) {
    case Node::Kind::text:
      return a.text == b.text;
    case Node::Kind::integer:
      return a.integer == b.integer;
    case Node::Kind::real:
      return a.real == b.real || (std::isnan(a.real) && std::isnan(b.real));
    case Node::Kind::flag:
      return a.flag == b.flag;
    case Node::Kind::table:
    case Node::Kind::array:
      break;
  }
  return a.children.size() == b.children.size();
}

// Tables are written after values: the order of keys may change, that of lists may not.
void law_of_same(const Node& a, const Node& b, const std::string& text) {
  law(a.kind == b.kind && same_value(a, b),
      "\"" + a.key + "\" was changed by writing it:\n" + text);
  for (std::size_t i = 0; i < a.children.size(); ++i) {
    const Node& child = a.children[i];
    const Node* other = a.is_table() ? b.find(child.key) : &b.children[i];
    law(other != nullptr, "\"" + child.key + "\" was lost by writing it:\n" + text);
    law_of_same(child, *other, text);
  }
}

}  // namespace

void toml(std::string_view input) {
  Node root;
  try {
    root = config::parse_text(input, "a.toml");
  } catch (const config::Error& error) {
    return law_of_refusal(error, "a.toml");
  }
  const std::string text = config::to_toml(root);
  try {
    law_of_same(root, config::parse_text(text, "written.toml"), text);
  } catch (const config::Error& error) {
    law(false, std::string("what is written can be read: ") + error.what() + "\n" + text);
  }
}

}  // namespace sinew::fuzz
