// tests/message.h - the text of what a call throws.
#pragma once

#include <exception>
#include <string>

namespace sinew::test {

// Returns the text of the exception that act() throws; empty if it throws none.
template <class Act>
std::string message(const Act& act) {
  try {
    act();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

}  // namespace sinew::test
