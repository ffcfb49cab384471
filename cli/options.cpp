// cli/options.cpp - the command line's description, in CLI11's terms.
#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <utility>

namespace sinew::cli {

namespace {

// "TEXT:{sobol,latin,random}" names the words that is_one_of() takes.
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == type.npos || end == type.npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

CommandTree::Shape shape_of(const CLI::Option& option) {
  CommandTree::Shape out{{}, option.get_description(), choices_of(option.get_type_name()), false};
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  out.takes_value = option.get_items_expected_max() > 0;
  return out;
}

// A group of options has no name: they are the command's own.
void add_options(const CLI::App& app, CommandTree& out) {
  for (const CLI::Option* option : app.get_options()) out.options.push_back(shape_of(*option));
  for (const CLI::App* group :
       app.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); }))
    add_options(*group, out);
}

CommandTree tree_of(const CLI::App& app) {
  CommandTree out{app.get_name(), app.get_description(), {}, {}};
  add_options(app, out);
  for (const CLI::App* sub :
       app.get_subcommands([](const CLI::App* a) { return !a->get_name().empty(); }))
    out.commands.push_back(tree_of(*sub));
  return out;
}

}  // namespace

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
  option_->check(CLI::IsMember(std::move(words)));
  return *this;
}

Option Option::is_between(int first, int last) {
  option_->check(CLI::Range(first, last));
  return *this;
}

Option Option::check(std::function<std::string(const std::string&)> wrong) {
  option_->check(std::move(wrong), "");
  return *this;
}

Option Option::takes_one() {
  option_->allow_extra_args(false);
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

Option Option::show_default() {
  option_->capture_default_str();
  return *this;
}

std::string Option::name() const { return option_->get_name(); }

Command Command::subcommand(const std::string& name, const std::string& description,
                            const std::string& example) {
  CLI::App& sub = *app_->add_subcommand(name, description);
  sub.footer("Example:\n  " + example);
  return Command(sub);
}

void Command::require_subcommand() { app_->require_subcommand(1); }

Command Command::one_of(const std::string& group) {
  CLI::App& options = *app_->add_option_group(group);
  options.require_option(1);
  return Command(options);
}

template <class Value>
Option Command::add_option(const std::string& names, Value& value, const std::string& description) {
  return Option(*app_->add_option(names, value, description));
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

void refuse(const std::string& option, const std::string& words) {
  throw CLI::ValidationError(option, words);
}

void require(const std::string& option) { throw CLI::RequiredError(option); }

}  // namespace sinew::cli
