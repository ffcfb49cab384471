#include "sinew/report/page/content.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "sinew/log/deflate.h"

namespace sinew::report::blob_test {
namespace {

std::string from_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(letters.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out += static_cast<char>(bits >> count);
  }
  return out;
}

// Columns as decoded by the page.
struct Read {
  std::vector<std::vector<std::int64_t>> ticks;
  std::vector<std::vector<float>> columns;
};
Read read(const Blob& blob) {
  const std::string bytes = log::inflated(from_base64(blob.base64()));
  std::size_t at = 0;
  const auto numbers = [&](std::size_t count) {
    std::vector<std::uint32_t> out(count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t rank = 0; rank < 4; ++rank)
        out[i] |=
            static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at + rank * count + i)))
            << (8 * rank);
    at += 4 * count;
    return out;
  };
  Read out;
  const Blob::Layout layout = blob.layout();
  for (const std::size_t count : layout.clocks) {
    std::int64_t tick = 0;
    std::vector<std::int64_t> ticks;
    for (const std::uint32_t step : numbers(count))
      ticks.push_back(tick += static_cast<std::int32_t>(step));
    out.ticks.push_back(std::move(ticks));
  }
  for (const int clock : layout.columns) {
    std::vector<float> column;
    for (const std::uint32_t bits : numbers(layout.clocks[static_cast<std::size_t>(clock)]))
      column.push_back(std::bit_cast<float>(bits));
    out.columns.push_back(std::move(column));
  }
  EXPECT_EQ(at, bytes.size());
  return out;
}

struct Column {
  signals::Times time_ns;
  signals::Column values;
  Samples samples() const { return {&time_ns, &values, "m"}; }
};

Column random_column(int seed, int count) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> value(0, 1e3);
  std::uniform_int_distribution<int> step(1, 50000);
  Column out;
  std::int64_t tick = 0;
  for (int i = 0; i < count; ++i) {
    out.time_ns.push_back((tick += step(random)) * 100000);
    out.values.push_back(value(random));
  }
  return out;
}

TEST(Blob, ComesBackAsFloatsAtTicks) {
  for (const int count : {0, 1, 2, 777, 8187}) {
    const Column a = random_column(count + 1, count), b = random_column(count + 2, count + 5);
    Blob blob;
    ASSERT_EQ(blob.add(a.samples()), 0);
    ASSERT_EQ(blob.add(b.samples()), 1);
    const Read back = read(blob);
    ASSERT_EQ(back.columns.size(), 2u);
    for (const auto& [column, i] : {std::pair{&a, 0u}, std::pair{&b, 1u}})
      for (std::size_t k = 0; k < column->values.size(); ++k) {
        EXPECT_EQ(back.columns[i][k], static_cast<float>(column->values[k]));
        EXPECT_EQ(back.ticks[i][k] * 100000, column->time_ns[k]);
      }
  }
}

TEST(Blob, KeepsWhatIsNoNumberAndRoundsToTheNextTick) {
  const Column c{{-149999, -50001, 49999, 50000, 1'000'000'049'999},
                 {std::nan(""), -0.0, std::numeric_limits<double>::infinity(), 1e-50, 3e38}};
  Blob blob;
  blob.add(c.samples());
  const Read back = read(blob);
  EXPECT_EQ(back.ticks[0], (std::vector<std::int64_t>{-1, -1, 0, 1, 10'000'000}));
  EXPECT_TRUE(std::isnan(back.columns[0][0]));
  EXPECT_TRUE(std::signbit(back.columns[0][1]));
  EXPECT_TRUE(std::isinf(back.columns[0][2]));
}

TEST(Blob, HoldsEveryColumnAndEveryClockOnce) {
  const Column a = random_column(1, 100);
  const Column same_times{a.time_ns, std::vector<double>(100, 2.0)};
  const Column other_times = random_column(2, 100);
  Blob blob;
  EXPECT_EQ(blob.add(a.samples()), 0);
  EXPECT_EQ(blob.add(same_times.samples()), 1);
  EXPECT_EQ(blob.add(other_times.samples()), 2);
  EXPECT_EQ(blob.add(a.samples()), 0);
  EXPECT_EQ(blob.layout().clocks, (std::vector<std::size_t>{100, 100}));
  EXPECT_EQ(blob.layout().columns, (std::vector<int>{0, 0, 1}));
}

// Each group of samples is replaced by its extremes, at the time of its first sample.
TEST(Blob, OfALongRunKeepsTheExtremesOfALine) {
  for (const int count : {65'537, 65'600, 200'000, 720'000}) {
    Column c = random_column(count, count);
    c.values.set(static_cast<std::size_t>(count) / 3, 1e9);
    c.values.set(static_cast<std::size_t>(count) / 2, std::nan(""));
    Blob blob;
    blob.add(c.samples());
    const Read back = read(blob);
    ASSERT_LE(back.columns[0].size(), Blob::most) << count;
    const std::size_t share = blob.thinned();
    ASSERT_GT(share, 0u);
    for (std::size_t k = 0; k < back.columns[0].size(); k += 2) {
      const std::size_t from = k / 2 * share;
      std::vector<double> part = c.values.slice(from, std::min(from + share, c.values.size()));
      std::erase_if(part, [](double x) { return std::isnan(x); });
      const auto [least, most] = std::ranges::minmax(part);
      const auto [a, b] = std::minmax(back.columns[0][k], back.columns[0][k + 1]);
      ASSERT_EQ(a, static_cast<float>(least));
      ASSERT_EQ(b, static_cast<float>(most));
      ASSERT_EQ(back.ticks[0][k] * 100000, c.time_ns[from]);
    }
  }
}

// All columns of a pose are from the same sample.
TEST(Blob, OfALongRunKeepsWholePoses) {
  const Column x = random_column(3, 100'000);
  Column y{x.time_ns, {}};
  for (const double value : x.values) y.values.push_back(2 * static_cast<float>(value));
  Blob blob;
  const int line = blob.add(x.samples()), pose = blob.add(x.samples(), Blob::As::pose);
  EXPECT_NE(line, pose);
  const auto other = static_cast<std::size_t>(blob.add(y.samples(), Blob::As::pose));
  const Read back = read(blob);
  const std::vector<float>& a = back.columns[static_cast<std::size_t>(pose)];
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(back.columns[other][k], 2 * a[k]);
    const auto row = std::ranges::lower_bound(x.time_ns, back.ticks[0][k] * 100000);
    ASSERT_EQ(a[k],
              static_cast<float>(x.values[static_cast<std::size_t>(row - x.time_ns.begin())]));
  }
  EXPECT_EQ(blob.layout().clocks.size(), 1u);
}

TEST(Base64, PadsAsRfc4648Does) {
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(to_base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace sinew::report::blob_test
