// run/folder/notices.h - receiver of the warnings and notes of a longer task, as they occur.
#pragma once

#include <functional>
#include <string_view>

namespace sinew::run {

// Messages are dropped if the function is empty. Errors are thrown instead.
struct Notices {
  std::function<void(std::string_view)> on_warning = {}, on_note = {};

  // Reports a condition that the user should examine.
  void warning(std::string_view text) const {
    if (on_warning) on_warning(text);
  }
  // Reports progress.
  void note(std::string_view text) const {
    if (on_note) on_note(text);
  }
};

}  // namespace sinew::run
