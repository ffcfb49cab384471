#include "sinew/live/study_pages.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "sinew/report/page/page.h"
#include "sinew/run/folder/page.h"

namespace sinew::live {
namespace {

constexpr const char* plain = "text/plain; charset=utf-8";

// The number behind `begin`, which is the whole rest of the path.
std::optional<std::size_t> number_in(std::string_view path, std::string_view begin) {
  if (!path.starts_with(begin)) return std::nullopt;
  path.remove_prefix(begin.size());
  std::size_t out = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), out);
  if (error != std::errc{} || end != path.data() + path.size()) return std::nullopt;
  return out;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

// A page that asks again by itself.
Reply it_goes(std::size_t row) {
  return {
      200,
      fmt::format(
          "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Row {0}</title>"
          "<meta http-equiv=\"refresh\" content=\"1\">"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
          "'unsafe-inline'\"><style>:root{{color-scheme:light dark}}body{{font:15px/1.6 "
          "system-ui,sans-serif;margin:3rem}}</style></head><body><p>Row {0} runs; its page comes "
          "by itself.</p></body></html>\n",
          row)};
}

}  // namespace

StudyPages::StudyPages(const std::filesystem::path& file, run::Notices notices)
    : notices_(std::move(notices)), feed_(file) {
  report::require_page("the page of a study");
}

Reply StudyPages::get(std::string_view path) try {
  if (path == "/") return page();
  if (const auto known = number_in(path, "/rows/")) return rows(*known);
  if (const auto row = number_in(path, "/run/")) return run_of(*row);
  return {404, "Nothing is here; the study is at the address that was printed.\n", plain};
} catch (const std::exception& wrong) {
  return {500, std::string(wrong.what()) + "\n", plain};
}

Reply StudyPages::page() {
  feed_.look();
  return {200, tune::study_page(feed_.study(), {.known = feed_.changes()})};
}

// What is wrong with a file that was there is said on the page that stands.
Reply StudyPages::rows(std::size_t known) {
  std::string error;
  try {
    feed_.look();
  } catch (const std::exception& wrong) {
    error = fmt::format(",\"error\":{}",
                        nlohmann::json(wrong.what())
                            .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  return {200,
          fmt::format("{{\"known\":{},\"expected\":{},\"rows\":{}{}}}", feed_.changes(),
                      feed_.study().expected, tune::rows_json(feed_.since(known)), error),
          "application/json"};
}

Reply StudyPages::run_of(std::size_t row) {
  if (!runs_.has(row)) {
    const tune::StudyRun run = tune::run_of(feed_.study(), row);
    if (runs_.is_busy()) return it_goes(row);
    runs_.begin(row, run);
  }
  const auto folder = runs_.folder(row);
  if (!folder) return it_goes(row);
  if (told_.insert(row).second)
    notices_.note(fmt::format("row {}: kept in {}", row, folder->string()));
  return {200, text_of(*folder / run::report_name)};
}

}  // namespace sinew::live
