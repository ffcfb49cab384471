#include "sinew/recording/stamp.h"

#include <fmt/format.h>

#include <chrono>

namespace sinew::recording {

namespace {

constexpr std::int64_t in_second = 1'000'000'000;  // [ns]
constexpr std::int64_t in_minute = 60 * in_second, in_hour = 60 * in_minute;
constexpr std::int64_t in_day = 24 * in_hour;

bool is_figure(char c) { return c >= '0' && c <= '9'; }

// Reads a stamp from left to right.
class StampReader {
 public:
  explicit StampReader(std::string_view text) : text_(text) {}

  std::optional<Stamp> read() {
    Stamp out;
    out.has_date = date(out);
    if (out.has_date) skip_between();
    out.has_time = at_ < text_.size() && time(out);
    if (at_ != text_.size() || !(out.has_date || out.has_time)) return std::nullopt;
    return out;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  // Reads a number of `least` to `most` digits; returns -1 if there are fewer or more.
  int number(std::size_t least, std::size_t most) {
    int value = 0;
    const std::size_t from = at_;
    while (is_figure(peek()) && at_ - from < most) value = 10 * value + (text_[at_++] - '0');
    digits_ = at_ - from;
    return digits_ < least || is_figure(peek()) ? -1 : value;
  }

  bool date(Stamp& out) {
    const std::size_t begin = at_;
    const int a = number(1, 4);
    const std::size_t digits = digits_;
    const char mark = peek();
    if (a < 0 || (mark != '-' && mark != '/' && mark != '.') || digits == 3) return back_to(begin);
    ++at_;
    const int b = number(1, 2);
    if (b < 0 || !take(mark)) return back_to(begin);
    const int c = number(digits == 4 ? 1 : 2, digits == 4 ? 2 : 4);
    if (c < 0 || digits_ == 3) return back_to(begin);
    if (digits == 4) {
      out.year = a;
      out.first = b;
      out.second = c;
      out.order = DateOrder::year_first;
    } else {
      out.first = a;
      out.second = b;
      out.year = digits_ == 2 ? 2000 + c : c;
      // Dates with points have the day first.
      out.order = mark == '.' ? DateOrder::day_first : DateOrder::unknown;
    }
    return true;
  }

  bool back_to(std::size_t at) {
    at_ = at;
    return false;
  }

  void skip_between() {
    if (take('T') || take('_')) return;
    take(',');
    while (take(' ')) {}
  }

  // Reads the fraction of a second to the nanosecond; ignores further digits.
  std::int64_t fraction() {
    if (peek() != '.' && peek() != ',') return 0;
    ++at_;
    std::int64_t value = 0, scale = in_second;
    while (is_figure(peek())) {
      if (scale > 1) {
        value = 10 * value + (peek() - '0');
        scale /= 10;
      }
      ++at_;
    }
    return value * scale;
  }

  bool time(Stamp& out) {
    const int a = number(1, 4);
    if (a < 0 || !take(':')) return false;
    const int b = number(2, 2);
    if (b < 0 || b > 59) return false;
    if (take(':')) {
      const int c = number(2, 2);
      if (c < 0 || c > 60) return false;
      out.time = a * in_hour + b * in_minute + c * in_second + fraction();
    } else if (peek() == '.' || peek() == ',') {
      out.time = a * in_minute + b * in_second + fraction();  // "05:30.5", as Excel shows it
    } else {
      out.time = a * in_hour + b * in_minute;
    }
    return half_of_day(out) && zone(out) && (!out.has_date || out.time <= in_day);
  }

  bool half_of_day(Stamp& out) {
    const std::size_t before = at_;
    while (take(' ')) {}
    const std::string_view rest = text_.substr(at_, 2);
    const bool morning = rest == "AM" || rest == "am", evening = rest == "PM" || rest == "pm";
    if (!morning && !evening) {
      at_ = before;
      return true;
    }
    at_ += 2;
    const std::int64_t hours = out.time / in_hour;
    if (hours < 1 || hours > 12) return false;
    if (hours == 12) out.time -= 12 * in_hour;
    if (evening) out.time += 12 * in_hour;
    return true;
  }

  bool zone(Stamp& out) {
    if (take('Z')) return out.has_zone = true;
    const std::size_t before = at_;
    while (take(' ')) {}
    const char sign = peek();
    if (sign != '+' && sign != '-') {
      at_ = before;
      return true;
    }
    ++at_;
    const int value = number(2, 4);
    if (value < 0) return false;
    int minutes = digits_ == 4 ? value / 100 * 60 + value % 100 : value * 60;
    if (digits_ == 2 && take(':')) {
      const int more = number(2, 2);
      if (more < 0) return false;
      minutes += more;
    }
    out.has_zone = true;
    out.offset = (sign == '-' ? -1 : 1) * minutes * in_minute;
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0, digits_ = 0;
};

}  // namespace

std::optional<Stamp> stamp_in(std::string_view text) {
  if (text.size() < 4 || text.size() > 40 || !is_figure(text.front())) return std::nullopt;
  return StampReader(text).read();
}

std::optional<std::int64_t> days_of(const Stamp& stamp, DateOrder order) {
  if (stamp.order != DateOrder::unknown) order = stamp.order;
  // Earlier years are not plausible, and 64 bits of nanoseconds do not hold later ones.
  const bool year = stamp.year >= 1900 && stamp.year <= 2200;
  if (order == DateOrder::unknown || !year) return std::nullopt;
  const bool day_first = order == DateOrder::day_first;
  const int month = day_first ? stamp.second : stamp.first;
  const int day_of_month = day_first ? stamp.first : stamp.second;
  const std::chrono::year_month_day date{std::chrono::year(stamp.year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day_of_month))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

std::string zone_text(std::int64_t offset) {
  if (offset == 0) return "Z";
  const std::int64_t size = offset < 0 ? -offset : offset;
  return fmt::format("{}{:02}:{:02}", offset < 0 ? '-' : '+', size / in_hour,
                     size / in_minute % 60);
}

std::string iso_text(std::int64_t nanoseconds) {
  std::int64_t days = nanoseconds / in_day, rest = nanoseconds % in_day;
  if (rest < 0) {
    rest += in_day;
    --days;
  }
  const std::chrono::year_month_day date{
      std::chrono::sys_days(std::chrono::days(static_cast<int>(days)))};
  std::string out =
      fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  rest / in_hour, rest / in_minute % 60, rest / in_second % 60);
  if (rest % in_second == 0) return out;
  std::string fraction = fmt::format("{:09}", rest % in_second);
  fraction.erase(fraction.find_last_not_of('0') + 1);
  return out + "." + fraction;
}

std::string start_text(std::int64_t nanoseconds, bool has_date, std::optional<std::int64_t> zone) {
  const std::string text = iso_text(nanoseconds + zone.value_or(0));
  return (has_date ? text : text.substr(text.find('T') + 1)) + (zone ? zone_text(*zone) : "");
}

}  // namespace sinew::recording
