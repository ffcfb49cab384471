// Common functions of the valve tests.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

using Values = std::vector<double>;

inline Measured table(std::vector<Column> columns) {
  Measured m{.file = "valve.csv", .columns = std::move(columns)};
  for (std::size_t i = 0; i < m.columns.front().values.size(); ++i)
    m.lines.push_back(static_cast<int>(i) + 2);
  return m;
}

inline const Estimate& parameter(const ValveResult& r, const std::string& name) {
  for (const Estimate& e : r.report.best().parameters)
    if (e.name == name) return e;
  throw std::out_of_range(name);
}

template <class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "none";
}

inline void expect_says(const std::string& text, const char* part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

}  // namespace sinew::identify
