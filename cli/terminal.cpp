#include "cli/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "cli/settings.h"
#include "sinew/config/utf8.h"

namespace sinew::cli {

namespace {

bool is_terminal(int stream) {
  const char* term = std::getenv("TERM");
  return isatty(stream) == 1 && !(term && std::string_view(term) == "dumb");
}

bool on_terminal() {
  static const bool terminal = is_terminal(STDERR_FILENO);
  return terminal;
}

bool takes_color(int stream) {
  const char* no_color = std::getenv("NO_COLOR");
  return is_terminal(stream) && !(no_color && *no_color);
}

std::string in_color(std::string_view text, std::string_view code) {
  if (!takes_color(STDERR_FILENO)) return std::string(text);
  return fmt::format("\033[{}m{}\033[0m", code, text);
}

// Ignores a stderr that is full or missing: a lost message must not end the work.
void to_stderr(std::string_view text) noexcept { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace

// Otherwise the next file that is opened would get the stream's number. The stdout that is opened
// here cannot be written, so that a lost result is an error.
void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      if (::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY) < 0) std::abort();
}

// Each line starts with its place, so that editors can jump there.
void error_in_words(std::string_view text) {
  to_stderr(in_color(config::printable(text), "31") + "\n");
}
void error(std::string_view text) { error_in_words(as_options(text)); }

void Messages::warning(std::string_view text) const {
  if (!quiet_)
    to_stderr(
        fmt::format("{} {}\n", in_color("warning:", "33"), config::printable(as_options(text))));
}

void Messages::note(std::string_view text) const {
  if (!quiet_) to_stderr(config::printable(as_options(text)) + "\n");
}

run::Notices Messages::notices() const {
  return {.on_warning = [*this](std::string_view text) { warning(text); },
          .on_note = [*this](std::string_view text) { note(text); }};
}

std::size_t width_of_output() {
  winsize size{};
  if (isatty(STDOUT_FILENO) != 1 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col;
}

bool output_has_color() { return takes_color(STDOUT_FILENO); }

ProgressBar::ProgressBar(const std::atomic<std::int64_t>& now, std::int64_t end, Steps steps,
                         bool quiet)
    : now_(&now), end_(end), steps_(steps) {
  if (!quiet && end > 0 && on_terminal()) thread_ = std::thread([this] { watch(); });
}

ProgressBar::ProgressBar(bool quiet) {
  if (!quiet && on_terminal()) thread_ = std::thread([this] { watch(); });
}

ProgressBar::~ProgressBar() {
  done_ = true;
  if (!thread_.joinable()) return;
  thread_.join();
  to_stderr("\r\033[K");
}

// Short runs end before anything is drawn.
void ProgressBar::watch() {
  constexpr auto look = std::chrono::milliseconds(20);
  for (int looks = 1; !done_; ++looks) {
    std::this_thread::sleep_for(look);
    if (done_) continue;
    if (now_ && looks % 5 == 0) draw(now_->load(std::memory_order_relaxed));
    if (!now_ && looks % 50 == 0) to_stderr(fmt::format("\rworking, {} s", looks / 50));
  }
}

void ProgressBar::draw(std::int64_t now) const {
  constexpr std::int64_t width = 30;
  const std::string done(static_cast<std::size_t>(width * now / end_), '#');
  to_stderr(fmt::format("\r[{:<{}}] {:3} %  {:.{}f} of {:.{}f} {}", done, width, 100 * now / end_,
                        static_cast<double>(now) * steps_.each, steps_.decimals,
                        static_cast<double>(end_) * steps_.each, steps_.decimals, steps_.unit));
  std::fflush(stderr);
}

}  // namespace sinew::cli
