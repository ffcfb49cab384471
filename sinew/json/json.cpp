#include "sinew/json/json.h"

#include <algorithm>
#include <istream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace sinew {

namespace {

using Library = nlohmann::ordered_json;

Library to_library(const Json& json) {
  switch (json.type()) {
    case Json::Type::boolean:
      return json.boolean();
    case Json::Type::integer:
      return json.integer();
    case Json::Type::natural:
      return json.natural();
    case Json::Type::real:
      return json.number();
    case Json::Type::text:
      return json.string();
    case Json::Type::array: {
      Library out = Library::array();
      for (const Json& item : json) out.push_back(to_library(item));
      return out;
    }
    case Json::Type::object: {
      Library out = Library::object();
      for (const auto& [name, value] : json.items()) out[name] = to_library(value);
      return out;
    }
    case Json::Type::null:
      break;
  }
  return {};
}

// Receives the parts of a text from the library's parser and builds the value directly, so that the
// library's own tree of values is never built.
struct Builder {
  // Limit of the nesting, above that of all own files: a value is copied and removed level by
  // level.
  static constexpr std::size_t deepest = 500;

  Json root;
  std::vector<Json*> open;  // lists and objects that are not finished, the innermost last
  std::string name;         // name of the next member
  std::string wrong;        // reason why the text is refused

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return put(value); }
  bool number_unsigned(std::uint64_t value) { return put(value); }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Library::binary_t&) { return refuse("found bytes, expected a text or a number"); }
  bool start_object(std::size_t) { return begin(Json::object()); }
  bool start_array(std::size_t) { return begin(Json::array()); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }
  bool key(std::string& value) {
    name = std::move(value);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Library::exception& error) {
    return refuse(error.what());
  }

 private:
  Json& next() {
    if (open.empty()) return root;
    Json& in = *open.back();
    if (in.is_object()) return in[name];
    in.push_back(nullptr);
    return in.back();
  }
  bool put(Json value) {
    next() = std::move(value);
    return true;
  }
  bool begin(Json list) {
    if (open.size() == deepest) return refuse("found lists within lists, more than 500 deep");
    Json& here = next();
    here = std::move(list);
    open.push_back(&here);
    return true;
  }
  bool end() {
    open.pop_back();
    return true;
  }
  bool refuse(std::string why) {
    wrong = std::move(why);
    return false;
  }
};

// Returns whether each item is a pair that begins with a text.
bool are_members(std::initializer_list<Json> items) {
  return std::ranges::all_of(items, [](const Json& item) {
    return item.is_array() && item.size() == 2 && item[0].is_string();
  });
}

}  // namespace

Json::Json(std::string value) : type_(Type::text) {
  value_.text = new std::string(std::move(value));
}

Json::Json(std::initializer_list<Json> items) : Json(array()) {
  if (!are_members(items)) {
    *value_.array = items;
    return;
  }
  Json members = object();
  for (const Json& item : items) members[item[0].string()] = item[1];
  *this = std::move(members);
}

Json::Json(const Json& other) : type_(other.type_), value_(other.value_) {
  if (type_ == Type::text) value_.text = new std::string(*other.value_.text);
  if (type_ == Type::array) value_.array = new std::vector<Json>(*other.value_.array);
  if (type_ == Type::object) value_.object = new std::vector<Member>(*other.value_.object);
}

Json& Json::operator=(Json other) noexcept {
  std::swap(type_, other.type_);
  std::swap(value_, other.value_);
  return *this;
}

Json::~Json() {
  if (type_ == Type::text) delete value_.text;
  if (type_ == Type::array) delete value_.array;
  if (type_ == Type::object) delete value_.object;
}

Json Json::array() {
  Json out;
  out.value_.array = new std::vector<Json>;
  out.type_ = Type::array;
  return out;
}

Json Json::array(std::initializer_list<Json> items) {
  Json out = array();
  *out.value_.array = items;
  return out;
}

Json Json::object() {
  Json out;
  out.value_.object = new std::vector<Member>;
  out.type_ = Type::object;
  return out;
}

Json Json::parse(std::string_view text) {
  Builder builder;
  if (!Library::sax_parse(text, &builder)) throw JsonError(builder.wrong);
  return std::move(builder.root);
}

bool Json::parse(std::string_view text, Json& out) {
  Builder builder;
  if (!Library::sax_parse(text, &builder)) return false;
  out = std::move(builder.root);
  return true;
}

bool Json::parse(std::istream& in, Json& out) {
  std::ostringstream text;
  text << in.rdbuf();
  return parse(text.view(), out);
}

std::string Json::text(int indent) const {
  return to_library(*this).dump(indent, ' ', false, Library::error_handler_t::replace);
}

std::string Json::exact_text(int indent) const try {
  return to_library(*this).dump(indent);
} catch (const Library::exception& wrong) {
  throw JsonError(wrong.what());
}

std::string Json::bytes() const {
  std::string out;
  Library::to_cbor(to_library(*this), nlohmann::detail::output_adapter<char>(out));
  return out;
}

Json Json::of_bytes(std::string_view bytes) {
  Builder builder;
  if (!Library::sax_parse(bytes, &builder, Library::input_format_t::cbor))
    throw JsonError(builder.wrong);
  return std::move(builder.root);
}

void Json::refuse(const char* wanted) const {
  constexpr const char* names[] = {"null",     "true or false", "a number", "a number",
                                   "a number", "a text",        "a list",   "an object"};
  throw JsonError(std::string("found ") + names[static_cast<int>(type_)] + ", expected " + wanted);
}

bool Json::boolean() const {
  if (!is_boolean()) refuse("true or false");
  return value_.boolean;
}

double Json::number() const {
  if (type_ == Type::integer) return static_cast<double>(value_.integer);
  if (type_ == Type::natural) return static_cast<double>(value_.natural);
  if (!is_real()) refuse("a number");
  return value_.real;
}

std::int64_t Json::integer() const {
  constexpr std::uint64_t largest = std::numeric_limits<std::int64_t>::max();
  if (type_ == Type::integer) return value_.integer;
  if (type_ != Type::natural || value_.natural > largest) refuse("a whole number");
  return static_cast<std::int64_t>(value_.natural);
}

const std::string& Json::string() const {
  if (!is_string()) refuse("a text");
  return *value_.text;
}

std::uint64_t Json::natural() const {
  if (type_ == Type::natural) return value_.natural;
  if (type_ != Type::integer || value_.integer < 0) refuse("a whole number from 0");
  return static_cast<std::uint64_t>(value_.integer);
}

std::vector<std::string> Json::strings() const {
  std::vector<std::string> out;
  for (const Json& item : list()) out.push_back(item.string());
  return out;
}

std::vector<double> Json::numbers() const {
  std::vector<double> out;
  for (const Json& item : list())
    out.push_back(item.is_null() ? std::numeric_limits<double>::quiet_NaN() : item.number());
  return out;
}

std::size_t Json::size() const {
  if (is_array()) return value_.array->size();
  if (is_object()) return value_.object->size();
  return is_null() ? 0 : 1;
}

Json& Json::operator[](std::size_t index) { return const_cast<Json&>(std::as_const(*this)[index]); }

const Json& Json::operator[](std::size_t index) const {
  if (!is_array() || index >= value_.array->size()) refuse("a longer list");
  return (*value_.array)[index];
}

void Json::push_back(Json item) {
  if (is_null()) *this = array();
  if (!is_array()) refuse("a list");
  value_.array->push_back(std::move(item));
}

const std::vector<Json>& Json::list() const& {
  if (!is_array()) refuse("a list");
  return *value_.array;
}

const Json* Json::begin() const { return is_array() ? value_.array->data() : nullptr; }
const Json* Json::end() const { return is_array() ? begin() + size() : nullptr; }
Json* Json::begin() { return is_array() ? value_.array->data() : nullptr; }
Json* Json::end() { return is_array() ? begin() + size() : nullptr; }

Json& Json::operator[](std::string_view key) {
  if (is_null()) *this = object();
  if (!is_object()) refuse("an object");
  if (const Json* found = find(key)) return const_cast<Json&>(*found);
  return value_.object->emplace_back(Member{std::string(key), Json()}).value;
}

const Json& Json::at(std::string_view key) const {
  const Json* found = find(key);
  if (found == nullptr) throw JsonError("found no \"" + std::string(key) + "\"");
  return *found;
}

const Json* Json::find(std::string_view key) const {
  if (!is_object()) return nullptr;
  for (const Member& m : *value_.object)
    if (m.name == key) return &m.value;
  return nullptr;
}

std::string Json::string(std::string_view key, std::string_view otherwise) const {
  const Json* found = find(key);
  return found != nullptr && found->is_string() ? found->string() : std::string(otherwise);
}

const std::vector<Json::Member>& Json::items() const& {
  if (!is_object()) refuse("an object");
  return *value_.object;
}

void Json::erase(std::string_view key) {
  if (is_object()) std::erase_if(*value_.object, [&](const Member& m) { return m.name == key; });
}

void Json::update(const Json& other) {
  for (const auto& [name, value] : other.items()) (*this)[name] = value;
}

std::ostream& operator<<(std::ostream& out, const Json& json) { return out << json.text(); }

bool operator==(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number()) {
    if (a.is_real() || b.is_real()) return a.number() == b.number();
    const bool below = a.type_ == Json::Type::integer && a.value_.integer < 0;
    const bool other = b.type_ == Json::Type::integer && b.value_.integer < 0;
    return below == other && a.value_.natural == b.value_.natural;
  }
  if (a.type_ != b.type_ || a.size() != b.size()) return false;
  if (a.is_boolean()) return a.value_.boolean == b.value_.boolean;
  if (a.is_string()) return *a.value_.text == *b.value_.text;
  if (a.is_array()) return std::ranges::equal(a, b);
  if (a.is_object())
    return std::ranges::all_of(a.items(), [&](const Json::Member& m) {
      const Json* other = b.find(m.name);
      return other != nullptr && m.value == *other;
    });
  return true;
}

}  // namespace sinew
