// run/folder/notices.h - where the warnings and notes of a longer piece of work go as they come.
#pragma once

#include <functional>
#include <string_view>

namespace sinew::run {

// An empty function hears nothing. Errors are no notices: they are thrown.
struct Notices {
  std::function<void(std::string_view)> on_warning = {}, on_note = {};

  // Tells what somebody should look at.
  void warning(std::string_view text) const {
    if (on_warning) on_warning(text);
  }
  // Tells what goes on.
  void note(std::string_view text) const {
    if (on_note) on_note(text);
  }
};

}  // namespace sinew::run
