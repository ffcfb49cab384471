// log/fixtures_test.h - fixtures of this folder's tests: a temporary folder and tables to log.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <string_view>

#include "sinew/log/writer.h"
#include "sinew/signals/table.h"

namespace sinew::log::testing {

// Temporary folder that is removed with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "sinew-log-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put_bytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

// Returns any kind of double: random bits, a subnormal, a whole number, a zero with either sign,
// NaN.
inline double any_double(std::mt19937_64& random) {
  switch (random() % 8) {
    case 0:
      return std::bit_cast<double>(random() & 0x800FFFFFFFFFFFFFu);
    case 1:
      return static_cast<double>(random() % 4096);
    case 2:
      return -0.0;
    case 3:
      return std::numeric_limits<double>::quiet_NaN();
    case 4:
      return static_cast<double>(random() % 100000) * 1e-3;
    default:
      break;
  }
  const double any = std::bit_cast<double>(random());
  return std::isfinite(any) ? any : 0.0;
}

// Returns a table of up to six topics with one to four fields and up to `samples` samples each.
inline signals::Table random_table(std::uint64_t seed, std::size_t samples) {
  std::mt19937_64 random(seed);
  signals::Table table;
  const char* const names[] = {"value", "x", "y \"quoted\"", "\xC3\xA4ngle"};
  for (std::size_t t = 0, topics = 1 + random() % 6; t < topics; ++t) {
    signals::Series& s = table.series.emplace_back();
    s.topic = {"/topic/" + std::to_string(t), "The topic with number " + std::to_string(t), {}};
    for (std::size_t f = 0, fields = 1 + random() % 4; f < fields; ++f)
      s.topic.fields.push_back({names[f], f % 2 ? "N" : "rad"});
    s.columns.resize(s.topic.fields.size());
    std::int64_t time = 0;
    for (std::size_t i = 0, n = random() % (samples + 1); i < n; ++i) {
      s.time_ns.push_back(time += static_cast<std::int64_t>(random() % 20'000'000));
      for (auto& column : s.columns) column.push_back(any_double(random));
    }
  }
  return table;
}

inline std::vector<signals::Topic> topics_of(const signals::Table& table) {
  std::vector<signals::Topic> topics;
  for (const signals::Series& s : table.series) topics.push_back(s.topic);
  return topics;
}

// Pushes sample 0 of every topic, then sample 1 of every topic, and so on: nearly in order of time.
inline void push_all(Writer& writer, const signals::Table& table) {
  bool more = true;
  for (std::size_t i = 0; more; ++i) {
    more = false;
    for (std::size_t t = 0; t < table.series.size(); ++t) {
      const signals::Series& s = table.series[t];
      if (i >= s.time_ns.size()) continue;
      double values[4];
      for (std::size_t f = 0; f < s.columns.size(); ++f) values[f] = s.columns[f][i];
      ASSERT_TRUE(
          writer.push(static_cast<std::uint16_t>(t), s.time_ns[i], {values, s.columns.size()}));
      more = true;
    }
  }
}

// Writes a log: indexed if `finished`, else the plain list of messages that a killed run leaves.
inline void write_log(const std::filesystem::path& file, const signals::Table& table,
                      bool finished) {
  Writer writer(file, topics_of(table), {{"experiment", "test"}, {"seed", "1"}}, {.version = "0"});
  push_all(writer, table);
  if (finished) writer.finish();
}

inline std::size_t messages_in(const signals::Table& table) {
  std::size_t n = 0;
  for (const signals::Series& s : table.series) n += s.time_ns.size();
  return n;
}

inline bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// Expects tables equal to the bit; with `prefix`, `got` may hold only the first samples.
inline void expect_same(const signals::Table& got, const signals::Table& wanted,
                        bool prefix = false) {
  ASSERT_TRUE(prefix || got.series.size() == wanted.series.size()) << got.series.size();
  ASSERT_LE(got.series.size(), wanted.series.size());
  for (std::size_t t = 0; t < got.series.size(); ++t) {
    const signals::Series &g = got.series[t], &w = wanted.series[t];
    ASSERT_EQ(g.topic.name, w.topic.name);
    ASSERT_EQ(g.topic.description, w.topic.description);
    ASSERT_EQ(g.columns.size(), w.columns.size());
    ASSERT_TRUE(prefix || g.time_ns.size() == w.time_ns.size()) << g.time_ns.size();
    ASSERT_LE(g.time_ns.size(), w.time_ns.size());
    for (std::size_t f = 0; f < g.columns.size(); ++f) {
      ASSERT_EQ(g.topic.fields[f].name, w.topic.fields[f].name);
      ASSERT_EQ(g.topic.fields[f].unit, w.topic.fields[f].unit);
      ASSERT_EQ(g.columns[f].size(), g.time_ns.size());
      for (std::size_t i = 0; i < g.time_ns.size(); ++i)
        ASSERT_TRUE(same_bits(g.columns[f][i], w.columns[f][i]))
            << g.topic.name << " field " << f << " sample " << i << ": " << g.columns[f][i]
            << " instead of " << w.columns[f][i];
    }
    for (std::size_t i = 0; i < g.time_ns.size(); ++i) ASSERT_EQ(g.time_ns[i], w.time_ns[i]);
  }
}

// Returns the text of the Error that `call` throws.
template <typename Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace sinew::log::testing
