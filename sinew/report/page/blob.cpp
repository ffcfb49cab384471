#include "sinew/report/page/blob.h"

#include <bit>
#include <cmath>

#include "sinew/log/deflate.h"
#include "sinew/signals/tick.h"

namespace sinew::report {
namespace {

// The numbers' bytes by rank, appended.
class Planes {
 public:
  explicit Planes(std::size_t numbers, std::string& out)
      : numbers_(numbers), at_(out.size()), out_(out) {
    out_.resize(at_ + 4 * numbers);
  }
  void put(std::size_t i, std::uint32_t bits) {
    for (std::size_t rank = 0; rank < 4; ++rank)
      out_[at_ + rank * numbers_ + i] = static_cast<char>(bits >> (8 * rank));
  }

 private:
  std::size_t numbers_, at_;
  std::string& out_;
};

std::int64_t tick_at(std::int64_t time_ns) {
  const std::int64_t half = signals::tick_nanoseconds / 2;
  return (time_ns + (time_ns < 0 ? -half : half)) / signals::tick_nanoseconds;
}

void put_clock(const std::vector<std::int64_t>& time_ns, std::string& out) {
  Planes planes(time_ns.size(), out);
  std::int64_t before = 0;
  for (std::size_t i = 0; i < time_ns.size(); ++i) {
    const std::int64_t tick = tick_at(time_ns[i]);
    planes.put(i, static_cast<std::uint32_t>(tick - before));
    before = tick;
  }
}

void put_column(const std::vector<double>& values, std::string& out) {
  Planes planes(values.size(), out);
  for (std::size_t i = 0; i < values.size(); ++i)
    planes.put(i, std::bit_cast<std::uint32_t>(static_cast<float>(values[i])));
}

}  // namespace

int Blob::clock_of(const std::vector<std::int64_t>& time_ns) {
  for (std::size_t i = 0; i < clocks_.size(); ++i)
    if (clocks_[i] == &time_ns || *clocks_[i] == time_ns) return static_cast<int>(i);
  clocks_.push_back(&time_ns);
  return static_cast<int>(clocks_.size()) - 1;
}

int Blob::add(const Samples& samples) {
  const auto [at, is_new] = known_.try_emplace(samples.values, static_cast<int>(columns_.size()));
  if (is_new) columns_.push_back({clock_of(*samples.time_ns), samples.values});
  return at->second;
}

Blob::Layout Blob::layout() const {
  Layout out;
  for (const auto* clock : clocks_) out.clocks.push_back(clock->size());
  for (const Column& column : columns_) out.columns.push_back(column.clock);
  return out;
}

std::string Blob::base64() const {
  std::string bytes;
  for (const auto* clock : clocks_) put_clock(*clock, bytes);
  for (const Column& column : columns_) put_column(*column.values, bytes);
  return to_base64(log::deflated(bytes));
}

std::string to_base64(std::string_view bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace sinew::report
