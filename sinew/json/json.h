// json/json.h - JSON value that can be built, accessed, parsed and written. Members of an object
// keep their order.
//
//   Json out{{"format", "sinew.study/1"}, {"seeds", {1, 2, 3}}};  // an object of two members
//   out["title"] = "a walk";
//   out.text();  // {"format":"sinew.study/1","seeds":[1,2,3],"title":"a walk"}
//
// A list in braces becomes an object if each item is a pair that begins with a text, else an array.
// array({...}) always makes an array. Json({"one"}) is an array to GCC and a text to Clang; write
// array({"one"}).
//
// Only json.cpp uses nlohmann's library, which parses and writes. Its templates take a compiler
// four seconds in each source that includes them, which was a third of the time to build the
// program.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

// Thrown where a text is not JSON or a value is not what it is taken for.
class JsonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Json {
 public:
  // Types of a value. A whole number from a signed type is an integer, from an unsigned type
  // natural.
  enum class Type { null, boolean, integer, natural, real, text, array, object };
  struct Member;

  // Constructs a value from the argument; null without one.
  Json() = default;
  Json(std::nullptr_t) {}
  Json(std::same_as<bool> auto value) : type_(Type::boolean) { value_.boolean = value; }
  template <std::signed_integral T>
  Json(T value) : type_(Type::integer) {
    value_.integer = value;
  }
  template <std::unsigned_integral T>
  requires(!std::same_as<T, bool>) Json(T value) : type_(Type::natural) { value_.natural = value; }
  template <std::floating_point T>
  Json(T value) : type_(Type::real) {
    value_.real = static_cast<double>(value);
  }
  Json(std::string value);
  Json(std::string_view value) : Json(std::string(value)) {}
  Json(const char* value) : Json(std::string(value)) {}
  Json(std::initializer_list<Json> items);
  // Constructs an array from a container of values.
  template <class List>
  requires requires(const List& list) {
    list.begin();
    list.end();
    list.size();
  } &&(!std::convertible_to<List, std::string_view>)&&(!std::same_as<List, Json>)
      Json(const List& list)
      : Json(array()) {
    for (const auto& one : list) push_back(Json(one));
  }

  // Copies have items of their own.
  Json(const Json& other);
  Json(Json&& other) noexcept : type_(other.type_), value_(other.value_) {
    other.type_ = Type::null;
  }
  Json& operator=(Json other) noexcept;
  ~Json();

  // Returns an array of these items; object() returns an object without members.
  static Json array();
  static Json array(std::initializer_list<Json> items);
  // Returns an array of of(item) for each item of a list.
  template <class List, class Of>
  static Json array(const List& list, const Of& of) {
    Json out = array();
    for (const auto& item : list) out.push_back(of(item));
    return out;
  }
  static Json object();

  // Returns the value of a JSON text. Throws JsonError, with the position of the error, if the text
  // is not JSON or is nested more than 500 levels deep.
  static Json parse(std::string_view text);
  // Writes the value into `out` and returns true; returns false, and leaves `out` unchanged, if the
  // text is refused.
  static bool parse(std::string_view text, Json& out);
  static bool parse(std::istream& in, Json& out);

  // Returns it as text: in one line, or with `indent` spaces before each inner line. Bytes that are
  // not UTF-8 become U+FFFD; numbers that are not finite become null.
  std::string text(int indent = -1) const;
  // Returns the text like text(); throws JsonError if a text in it is not UTF-8.
  std::string exact_text(int indent = -1) const;

  // Returns the value in CBOR (RFC 8949), which keeps NaN and infinity; of_bytes() reads it. Throws
  // JsonError if the bytes are not CBOR.
  std::string bytes() const;
  static Json of_bytes(std::string_view bytes);

  // Returns the type of the value; the others return whether it has that type.
  Type type() const { return type_; }
  bool is_null() const { return type_ == Type::null; }
  bool is_boolean() const { return type_ == Type::boolean; }
  bool is_real() const { return type_ == Type::real; }
  bool is_number() const { return is_real() || type_ == Type::integer || type_ == Type::natural; }
  bool is_string() const { return type_ == Type::text; }
  bool is_array() const { return type_ == Type::array; }
  bool is_object() const { return type_ == Type::object; }

  // Returns the value of this type. Throws JsonError if it has another type.
  bool boolean() const;
  double number() const;
  std::int64_t integer() const;
  std::uint64_t natural() const;
  const std::string& string() const;
  std::vector<std::string> strings() const;
  std::vector<double> numbers() const;  // null is not a number

  // Returns the number of items or members; 0 for null, and 1 for a text, a number or a boolean.
  std::size_t size() const;
  bool empty() const { return size() == 0; }

  // Returns an item of an array. Throws JsonError if the array has no such item.
  Json& operator[](std::size_t index);
  const Json& operator[](std::size_t index) const;
  Json& operator[](int index) { return (*this)[static_cast<std::size_t>(index)]; }
  const Json& operator[](int index) const { return (*this)[static_cast<std::size_t>(index)]; }
  Json& front() { return (*this)[0]; }
  const Json& front() const { return (*this)[0]; }
  Json& back() { return (*this)[size() - 1]; }
  const Json& back() const { return (*this)[size() - 1]; }
  // Appends an item; null becomes an array. Throws JsonError if it is neither.
  void push_back(Json item);
  // Returns all items. Throws JsonError if it is not an array.
  const std::vector<Json>& list() const&;
  void list() const&& = delete;  // the items would not outlive the loop
  // Returns the range of the items of an array, which is empty for every other type. Members of an
  // object are in items().
  const Json* begin() const;
  const Json* end() const;
  Json* begin();
  Json* end();

  // Returns a member of an object. The first two add a missing member, and turn null into an
  // object; the others throw JsonError if it is missing.
  Json& operator[](std::string_view key);
  Json& operator[](const char* key) { return (*this)[std::string_view(key)]; }
  const Json& operator[](std::string_view key) const { return at(key); }
  const Json& operator[](const char* key) const { return at(key); }
  const Json& at(std::string_view key) const;
  const Json* find(std::string_view key) const;  // nullptr if it is missing
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  // Returns the text of a member; `otherwise` if it is missing or not a text.
  std::string string(std::string_view key, std::string_view otherwise) const;
  const std::vector<Member>& items() const&;
  void items() const&& = delete;
  void erase(std::string_view key);
  void update(const Json& other);  // sets the members of another

  friend bool operator==(const Json& a, const Json& b);
  friend std::ostream& operator<<(std::ostream& out, const Json& json);

 private:
  union Value {
    bool boolean;
    std::int64_t integer;
    std::uint64_t natural;
    double real;
    std::string* text;
    std::vector<Json>* array;
    std::vector<Member>* object;
  };

  [[noreturn]] void refuse(const char* wanted) const;

  Type type_ = Type::null;
  Value value_{};
};

// A member of an object.
struct Json::Member {
  std::string name;
  Json value;
};

}  // namespace sinew
