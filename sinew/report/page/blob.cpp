#include "sinew/report/page/blob.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

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

// How many samples of a clock two stand for; 0: each for itself. Odd, so that of what goes up and
// down by turns, as a valve does, both are seen.
std::size_t share_of(std::size_t samples) {
  return samples <= Blob::most ? 0 : ((2 * samples + Blob::most - 1) / Blob::most) | 1;
}

std::size_t shown_of(std::size_t samples) {
  const std::size_t share = share_of(samples);
  return share == 0 ? samples : 2 * ((samples + share - 1) / share);
}

// The first sample of a share, and its middle.
std::size_t row_of(std::size_t shown, std::size_t samples) {
  const std::size_t share = share_of(samples);
  if (share == 0) return shown;
  return std::min(shown / 2 * share + (shown % 2) * (share / 2), samples - 1);
}

void put_clock(const signals::Times& time_ns, std::string& out) {
  const std::size_t shown = shown_of(time_ns.size());
  Planes planes(shown, out);
  std::int64_t before = 0;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::int64_t tick = tick_at(time_ns[row_of(i, time_ns.size())]);
    planes.put(i, static_cast<std::uint32_t>(tick - before));
    before = tick;
  }
}

// The least and the greatest number, in the order in which they come; where there is none, that.
std::pair<double, double> extremes(const signals::Column& values, std::size_t from,
                                   std::size_t to) {
  double least = values[from], most = least;
  bool rises = true;  // the greatest one comes last
  for (std::size_t i = from + 1; i < to; ++i) {
    const double x = values[i];
    if (std::isnan(x)) continue;
    if (!(x >= least)) least = x, rises = false;
    if (!(x <= most)) most = x, rises = true;
  }
  return rises ? std::pair{least, most} : std::pair{most, least};
}

void put_column(const signals::Column& values, Blob::As as, std::string& out) {
  const std::size_t samples = values.size(), shown = shown_of(samples), share = share_of(samples);
  Planes planes(shown, out);
  const auto put = [&](std::size_t i, double value) {
    planes.put(i, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  };
  if (share == 0 || as == Blob::As::pose) {
    for (std::size_t i = 0; i < shown; ++i) put(i, values[row_of(i, samples)]);
    return;
  }
  for (std::size_t i = 0; i < shown; i += 2) {
    const std::size_t from = i / 2 * share;
    const auto [first, second] = extremes(values, from, std::min(from + share, samples));
    put(i, first);
    put(i + 1, second);
  }
}

}  // namespace

int Blob::clock_of(const signals::Times& time_ns) {
  for (std::size_t i = 0; i < clocks_.size(); ++i)
    if (clocks_[i] == &time_ns || *clocks_[i] == time_ns) return static_cast<int>(i);
  clocks_.push_back(&time_ns);
  return static_cast<int>(clocks_.size()) - 1;
}

int Blob::add(const Samples& samples, As as) {
  if (share_of(samples.values->size()) == 0) as = As::line;  // both are the same
  const auto [at, is_new] =
      known_.try_emplace({samples.values, as}, static_cast<int>(columns_.size()));
  if (is_new) columns_.push_back({clock_of(*samples.time_ns), samples.values, as});
  return at->second;
}

std::size_t Blob::thinned() const {
  std::size_t out = 0;
  for (const auto* clock : clocks_) out = std::max(out, share_of(clock->size()));
  return out;
}

Blob::Layout Blob::layout() const {
  Layout out;
  for (const auto* clock : clocks_) out.clocks.push_back(shown_of(clock->size()));
  for (const Column& column : columns_) out.columns.push_back(column.clock);
  return out;
}

std::string Blob::base64() const {
  std::string bytes;
  for (const auto* clock : clocks_) put_clock(*clock, bytes);
  for (const Column& column : columns_) put_column(*column.values, column.as, bytes);
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
