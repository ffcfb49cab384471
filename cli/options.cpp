// cli/options.cpp - the command line's description, in CLI11's terms.
#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "cli/usage.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {

namespace {

constexpr const char* whole_number = "N";
constexpr const char* usual_heading = "Options";  // CLI11's

// CLI11 has no place for the words that is_one_of() takes: they are in the description of its
// check, each behind this letter, which no word contains. Words may contain commas and blanks.
constexpr char before_choice = '\x1f';

std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  std::vector<std::string> out;
  for (std::size_t at = type.find(before_choice); at < type.size();) {
    const std::size_t end = std::min(type.find(before_choice, at + 1), type.size());
    out.push_back(type.substr(at + 1, end - at - 1));
    at = end;
  }
  return out;
}

CommandTree::Shape shape_of(const CLI::Option& option, const CLI::App& of) {
  CommandTree::Shape out;
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  out.choices = choices_of(option);
  const std::string type = option.get_type_name();
  out.value = out.names.empty() ? option.get_name() : type.substr(0, type.find(':'));
  out.description = option.get_description();
  out.default_text = option.get_default_str();
  if (of.get_name().empty() && of.get_parent()) out.group = of.get_group();
  if (option.get_group() != usual_heading) out.heading = option.get_group();
  if (option.get_items_expected_max() > 0) {
    const auto count = [](int n) { return std::min(n, CommandTree::many); };
    out.least = count(option.get_items_expected_min());
    out.most = count(option.get_items_expected_max());
    // A list that takes one word at a time is named again for the next.
    out.repeats = out.most == CommandTree::many && !option.get_allow_extra_args();
    if (out.repeats) out.most = out.least;
  }
  out.required = option.get_required();
  return out;
}

// A group of options has no name: they are the command's own.
void add_options(const CLI::App& app, CommandTree& out) {
  for (const CLI::Option* option : app.get_options()) out.options.push_back(shape_of(*option, app));
  for (const CLI::App* group :
       app.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); }))
    add_options(*group, out);
}

// Words of the form in which all of Sinew complains; the option's name is put before them.
std::string complaint(const std::string& found, const std::string& expected,
                      const std::string& try_this = "") {
  return fmt::format("found {}; expected {}{}", found, expected,
                     try_this.empty() ? "" : "; try " + try_this);
}

std::string_view without_plus(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return text;
}

// The checks of CLI11 and its conversions speak of types, these of numbers. What they let pass is
// then as CLI11 takes it: "010" would be 8 there.
std::string no_whole_number(std::string& text, long long first, long long last,
                            const std::string& expected) {
  const std::string_view digits = without_plus(text);
  long long value = 0;
  const char* end = digits.data() + digits.size();
  const auto [at, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc{} || at != end || value < first || value > last)
    return complaint(config::in_quotes(text), expected);
  text = std::to_string(value);
  return "";
}

std::string no_number(std::string& text) {
  const std::string_view digits = without_plus(text);
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto [at, error] = std::from_chars(digits.data(), end, value);
  if (error == std::errc{} && at == end) return "";  // how large it may be, the library knows
  const bool comma = text.find(',') != text.npos;
  return complaint(config::in_quotes(text), "a number", comma ? "a point for the comma" : "");
}

template <class Value>
void check_kind(CLI::Option& option) {
  option.type_name("VALUE");
  if constexpr (std::is_same_v<Value, double>) {
    option.type_name("NUMBER")->check(CLI::Validator(no_number, ""));
  } else if constexpr (std::is_integral_v<Value> || std::is_same_v<Value, std::optional<int>>) {
    constexpr long long first = std::is_unsigned_v<Value> ? 0 : std::numeric_limits<int>::min();
    const auto wrong = [](std::string& text) {
      return no_whole_number(text, first, std::numeric_limits<int>::max(),
                             first == 0 ? "a whole number, not below 0" : "a whole number");
    };
    option.type_name(whole_number)->check(CLI::Validator(wrong, ""));
  }
}

// A help that is somebody's function of the tree.
class HelpOf final : public CLI::FormatterBase {
 public:
  explicit HelpOf(Command::Help help) : help_(std::move(help)) {}
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    return help_(tree_of(*app), words_to(*app));
  }

 private:
  Command::Help help_;
};

}  // namespace

std::string either_of(const std::vector<std::string>& choices) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_' || c == '.';
  };
  const auto has_letters = [&](const std::string& word) {
    return std::ranges::all_of(word, plain) &&
           std::ranges::any_of(word, [](unsigned char c) { return std::isalnum(c); });
  };
  std::vector<std::string> out = choices;
  if (!std::ranges::all_of(out, has_letters))
    for (std::string& word : out) word = config::in_quotes(word);
  return config::either({out.begin(), out.end()});
}

std::string CommandTree::Shape::name() const { return names.empty() ? value : names.back(); }

std::string words_to(const CLI::App& app) {
  if (!app.get_parent()) return "sinew";
  const std::string above = words_to(*app.get_parent());
  return app.get_name().empty() ? above : above + " " + app.get_name();
}

CommandTree::Shape shape_of(const CLI::Option& option) { return shape_of(option, CLI::App()); }

CommandTree tree_of(const CLI::App& app) {
  CommandTree out{app.get_name(), app.get_description(), app.get_footer(), {}, {}};
  add_options(app, out);
  for (const CLI::App* sub :
       app.get_subcommands([](const CLI::App* a) { return !a->get_name().empty(); }))
    out.commands.push_back(tree_of(*sub));
  return out;
}

Option Option::required(bool needed) {
  option_->required(needed);
  return *this;
}

Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}

Option Option::needs(Option other) {
  option_->needs(other.option_);
  return *this;
}

Option Option::is_one_of(std::vector<std::string> words) {
  std::string choices;
  for (const std::string& word : words) choices += before_choice + word;
  const auto wrong = [words = std::move(words)](const std::string& text) -> std::string {
    const std::vector<std::string_view> all(words.begin(), words.end());
    if (std::ranges::find(all, text) != all.end()) return "";
    const std::string near = config::closest_in_quotes(text, all);
    return complaint(config::in_quotes(text), either_of(words), near);
  };
  option_->check(CLI::Validator(wrong, choices));
  return *this;
}

Option Option::is_between(int first, int last) {
  const auto wrong = [first, last](std::string& text) {
    return no_whole_number(text, first, last, fmt::format("a whole number, {} to {}", first, last));
  };
  option_->transform(CLI::Validator(wrong, ""));  // before the check of its kind
  return *this;
}

Option Option::check(std::function<std::string(const std::string&)> wrong) {
  const auto says = [wrong = std::move(wrong)](std::string& text) { return wrong(text); };
  option_->transform(CLI::Validator(says, ""));  // before the check of its kind
  return *this;
}

Option Option::takes_one() {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::once() {
  option_->expected(1);
  return *this;
}

Option Option::takes_all() {
  option_->expected(1, CLI::detail::expected_max_vector_size);
  return *this;
}

Option Option::takes(int least, int most, const std::string& in_the_help) {
  option_->expected(least, most);
  option_->option_text(in_the_help);
  return *this;
}

Option Option::split_at(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}

Option Option::under(const std::string& heading) {
  option_->group(heading);
  return *this;
}

Option Option::show_default() {
  option_->capture_default_str();
  return *this;
}

std::string Option::name() const { return option_->get_name(); }

Command Command::subcommand(const std::string& name, const std::string& description,
                            const std::string& example) {
  CLI::App& sub = *app_->add_subcommand(name, description);
  sub.footer(example);
  return Command(sub);
}

void Command::require_subcommand() { app_->require_subcommand(1); }

Command Command::one_of(const std::string& group) {
  CLI::App& options = *app_->add_option_group(group);
  options.require_option(1);
  options.set_help_flag();  // the command has one
  return Command(options);
}

template <class Value>
Option Command::add_option(const std::string& names, Value& value, const std::string& description) {
  CLI::Option& added = *app_->add_option(names, value, description);
  check_kind<Value>(added);
  return Option(added);
}

template Option Command::add_option(const std::string&, std::string&, const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::string>&,
                                    const std::string&);
template Option Command::add_option(const std::string&, double&, const std::string&);
template Option Command::add_option(const std::string&, int&, const std::string&);
template Option Command::add_option(const std::string&, std::size_t&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<int>&, const std::string&);

Option Command::add_flag(const std::string& names, bool& value, const std::string& description) {
  return Option(*app_->add_flag(names, value, description));
}

Option Command::option(const std::string& name) { return Option(*app_->get_option(name)); }

CommandTree Command::tree() const { return tree_of(*app_); }

void Command::callback(std::function<void()> understood) { app_->callback(std::move(understood)); }

void Command::shows_help(Help help) { app_->formatter(std::make_shared<HelpOf>(std::move(help))); }

void refuse(const std::string& option, const std::string& found, const std::string& expected) {
  throw CLI::ValidationError(option, complaint(found, expected));
}

void require(const std::string& option, const std::string& expected) {
  throw CLI::ValidationError(option, "missing; expected " + expected);
}

}  // namespace sinew::cli
