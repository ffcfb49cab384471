#include "sinew/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>

#include "sinew/config/diagnostics.h"
#include "sinew/film/video.h"
#include "sinew/json/json.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/compared.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/page.h"

namespace sinew::film {
namespace {

namespace fs = std::filesystem;

constexpr int most_frames = 20000;
constexpr int smallest = 100, largest = 3840;  // a side [pixels]
// Browsers show a frame of a GIF for two hundredths of a second at least.
constexpr int most_of_gif = 50, most_per_second = 120;
constexpr int palette_frames = 12;  // read for its colors

[[noreturn]] void wrong(const char* name, std::string found, std::string expected,
                        std::string try_this = "") {
  config::fail({name, 0, 0}, "", std::move(found), std::move(expected), std::move(try_this));
}

void check_side(const char* name, int pixels) {
  if (pixels < smallest || pixels > largest)
    wrong(name, fmt::format("{}", pixels), fmt::format("{} to {} pixels", smallest, largest));
}

constexpr std::string_view base64_letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::array<std::uint32_t, 256> values_of_letters() {
  std::array<std::uint32_t, 256> out{};
  for (std::uint32_t i = 0; i < base64_letters.size(); ++i)
    out[static_cast<unsigned char>(base64_letters[i])] = i;
  return out;
}

std::string from_base64(std::string_view text) {
  static const std::array<std::uint32_t, 256> value = values_of_letters();
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = (bits << 6) | value[static_cast<unsigned char>(c)];
    if ((count += 6) < 8) continue;
    count -= 8;
    out += static_cast<char>((bits >> count) & 0xFF);
  }
  return out;
}

// Once the page has read its samples.
void wait_until_ready(Chromium& browser) {
  const auto begin = std::chrono::steady_clock::now();
  while (browser.text("document.documentElement?.dataset.ready ?? ''") != "yes") {
    const std::string failed = browser.text("document.querySelector('.failed')?.textContent ?? ''");
    if (!failed.empty()) throw std::runtime_error(failed);
    if (std::chrono::steady_clock::now() - begin > std::chrono::minutes(2))
      throw std::runtime_error("the run's page was not ready within two minutes");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// Times of frames, from the run's `begin` to its `end`.
std::vector<double> times_of(const FilmOptions& options, double begin, double end) {
  const double from = std::max(options.from, begin), to = std::min(options.to, end);
  if (!(from < to)) {
    const bool late = options.from >= end;
    wrong(late ? "from" : "to", fmt::format("{:.4g} s", late ? options.from : options.to),
          fmt::format("a time of the run, {:.4g} s to {:.4g} s", begin, end));
  }
  const double step = options.speed / options.frames_per_second;
  const double count = std::max(1.0, std::floor((to - from) / step + 1e-6));
  if (count > most_frames)
    wrong("to", fmt::format("{:.0f} frames", count), fmt::format("{} at most", most_frames),
          "a shorter time, a higher speed or fewer frames per second");
  std::vector<double> out;
  for (int i = 0; i < static_cast<int>(count); ++i) out.push_back(from + i * step);
  return out;
}

[[noreturn]] void without_drawing(const std::string& run) {
  config::fail({run, 0, 0}, "", "a run without a drawing",
               "a run of a robot or of the test stand whose file has the places of its parts");
}

std::string number(double value) { return Json(value).text(); }

}  // namespace

Kind kind_of(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".gif") return Kind::gif;
  if (ending == ".mp4") return Kind::mp4;
  if (ending == ".webm") return Kind::webm;
  wrong("output", config::in_quotes(file.string()), "a file that ends with .gif, .mp4 or .webm",
        config::in_quotes(fs::path(file).replace_extension(".gif").string()));
}

void check(const FilmOptions& o, Kind kind) {
  check_side("width", o.width);
  check_side("height", o.height);
  if (kind != Kind::gif && (o.width % 2 != 0 || o.height % 2 != 0))
    wrong(o.width % 2 != 0 ? "width" : "height",
          fmt::format("{}", o.width % 2 != 0 ? o.width : o.height),
          "an even number of pixels, as MP4 and WebM need");
  const int most = kind == Kind::gif ? most_of_gif : most_per_second;
  if (o.frames_per_second < 1 || o.frames_per_second > most)
    wrong("fps", fmt::format("{}", o.frames_per_second),
          fmt::format("1 to {} frames per second, as a {} shows them", most,
                      kind == Kind::gif ? "GIF" : "video"));
  if (!(o.speed >= 1e-3 && o.speed <= 1000))
    wrong("speed", fmt::format("{:.4g}", o.speed), "0.001 to 1000 seconds of the run per second");
  if (!(o.from < o.to))
    wrong("from", fmt::format("{:.4g} s", o.from), fmt::format("a time before {:.4g} s", o.to));
}

Filming::Filming(const fs::path& run, const std::string& machine, const FilmOptions& options,
                 const std::atomic<bool>& stop, const run::Notices& notices)
    : options_(options), stop_(stop) {
  report::require_page("the film");
  const run::RecordedRun recorded = run::recorded_run(run);
  open(run::page_of(recorded, machine, notices));
  if (browser_->evaluate("Boolean(window.sinew.page.scene)") != "true")
    without_drawing(run.string());
  prepare();
}

Filming::Filming(const std::vector<std::string>& runs, const report::AlignOptions& align_options,
                 const FilmOptions& options, const std::atomic<bool>& stop,
                 const run::Notices& notices)
    : options_(options), stop_(stop) {
  report::require_page("the film");
  open(report::page(run::compare_runs(runs, align_options, {}, notices)));
  const Json drawn = Json::parse(browser_->evaluate("window.sinew.page.machines.drawn"));
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (std::ranges::find(drawn, Json(i)) == drawn.end()) without_drawing(runs[i]);
  prepare();
}

void Filming::open(const std::string& page) {
  browser_ = std::make_unique<Chromium>(stop_);
  run::write_file(browser_->folder() / "run.html", page, log::Replacement::Sync::later);
  browser_->open(browser_->folder() / "run.html");
  wait_until_ready(*browser_);
}

void Filming::prepare() {
  browser_->evaluate(report::film_script());
  const Json span = Json::parse(browser_->evaluate("window.sinew_span()"));
  times_ = times_of(options_, span[0].number(), span[1].number());
  browser_->evaluate(
      fmt::format("window.sinew_film({})", Json{{"size", {options_.width, options_.height}},
                                                {"dark", options_.dark},
                                                {"still", options_.still},
                                                {"speed", options_.speed}}
                                               .text()));
}

void Filming::make(const fs::path& file, std::atomic<std::int64_t>& done) {
  const Kind kind = kind_of(file);
  check(options_, kind);
  if (kind == Kind::gif)
    make_gif(file, done);
  else
    make_video(file, kind, done);
}

void Filming::make_gif(const fs::path& file, std::atomic<std::int64_t>& done) {
  std::vector<double> looked_at;
  const std::size_t n = times_.size();
  for (std::size_t i = 0; i < palette_frames; ++i)
    looked_at.push_back(times_[i * n / palette_frames]);
  browser_->evaluate(fmt::format("window.film.choose_palette({})", Json(looked_at).text()));
  std::string bytes;
  for (std::size_t i = 0; i < n; ++i) {
    // A GIF counts hundredths of a second: rounded so that the film does not drift.
    const auto hundredths = [&](std::size_t frame) {
      return std::lround(100.0 * static_cast<double>(frame) / options_.frames_per_second);
    };
    bytes +=
        from_base64(browser_->text(fmt::format("window.film.gif_frame({}, {})", number(times_[i]),
                                               10 * (hundredths(i + 1) - hundredths(i)))));
    ++done;
  }
  bytes += from_base64(browser_->text("window.film.gif_end()"));
  run::write_file(file, bytes);
}

void Filming::make_video(const fs::path& file, Kind kind, std::atomic<std::int64_t>& done) {
  Video video(file, kind, options_.frames_per_second, browser_->folder() / "video-words");
  for (const double t : times_) {
    video.add(from_base64(browser_->text(fmt::format("window.film.png({})", number(t)))));
    ++done;
  }
  video.finish();
}

}  // namespace sinew::film
