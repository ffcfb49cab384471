#include "sinew/film/chromium.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "sinew/film/process.h"
#include "sinew/host/temporary_folder.h"
#include "sinew/json/json.h"

namespace sinew::film {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto patience = std::chrono::seconds(60);  // for a reply, on a slow computer
constexpr int commands = 3, answers = 4;             // the files that the browser reads and writes

// Its options, without the dashes before them. Letters are drawn alike on every screen.
constexpr std::string_view browser_options[] = {"headless",
                                                "remote-debugging-pipe",
                                                "no-first-run",
                                                "disable-gpu",
                                                "disable-dev-shm-usage",
                                                "disable-background-networking",
                                                "disable-extensions",
                                                "disable-lcd-text",
                                                "font-render-hinting=none",
                                                "force-color-profile=srgb",
                                                "force-device-scale-factor=1",
                                                "window-size=1280,800"};

std::vector<std::string> arguments_of(const fs::path& program, const fs::path& profile) {
  std::vector<std::string> out{program.string()};
  const auto add = [&](std::string_view option) { out.push_back("--" + std::string(option)); };
  for (const std::string_view option : browser_options) add(option);
  add("user-data-dir=" + profile.string());
  // The browser does not start its sandbox for root, and the page is one that was made here.
  if (::geteuid() == 0) add("no-sandbox");
  out.emplace_back("about:blank");
  return out;
}

// "file:///home/a%20b/page.html"
std::string url_of(const fs::path& file) {
  std::string out = "file://";
  for (const char c : fs::absolute(file).string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("/-_.~").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

}  // namespace

fs::path find_chromium() {
  if (const char* named = std::getenv("CHROMIUM"); named && *named) return named;
  return find_program({"chromium-headless-shell", "chromium", "chromium-browser", "google-chrome",
                       "google-chrome-stable"});
}

struct Chromium::Impl {
  explicit Impl(const std::atomic<bool>& asked) : stop(asked) {}
  ~Impl();

  void start();
  Json ask(const char* method, Json parameters);
  std::string next_message();
  [[noreturn]] void fail(const std::string& why) const;

  const std::atomic<bool>& stop;
  fs::path folder = host::make_temporary_folder("sinew-film");
  End to, from;
  pid_t pid = -1;
  int last = 0;  // number of a command
  std::string session;
  std::string received;  // of a message that is not whole
};

Chromium::Impl::~Impl() {
  to.close();  // it ends when its pipe is closed
  if (pid > 0) {
    if (!ends_within(pid, 3)) kill_group(pid);
    wait_for(pid);
  }
  std::error_code ignored;
  // Helpers of the browser may still write into its profile for a moment.
  for (int i = 0; i < 20 && fs::exists(folder, ignored); ++i) {
    fs::remove_all(folder, ignored);
    if (ignored) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void Chromium::Impl::start() {
  const fs::path program = find_chromium();
  if (program.empty())
    throw std::runtime_error(
        "no Chromium, which draws the frames, is on the PATH; try apt-get install chromium, or "
        "CHROMIUM=<its file>");
  Pipe down = Pipe::make(), up = Pipe::make();
  try {
    pid = film::start(arguments_of(program, folder / "profile"),
                      {{down.read.file(), commands}, {up.write.file(), answers}}, folder / "words");
  } catch (const std::system_error& e) {
    throw std::runtime_error(
        fmt::format("{}: {}; expected Chromium or Chrome, which draws the "
                    "frames",
                    program.string(), e.code().message()));
  }
  to = std::move(down.write);
  from = std::move(up.read);
}

void Chromium::Impl::fail(const std::string& why) const {
  const std::string words = last_words(folder / "words");
  throw std::runtime_error(fmt::format("the browser that draws the frames, {}, {}{}",
                                       find_chromium().string(), why,
                                       words.empty() ? "" : "; its last words: " + words));
}

std::string Chromium::Impl::next_message() {
  const auto begin = Clock::now();
  while (true) {
    if (const std::size_t end = received.find('\0'); end != received.npos) {
      std::string out = received.substr(0, end);
      received.erase(0, end + 1);
      return out;
    }
    if (stop) throw Stopped();
    if (Clock::now() - begin > patience) fail("does not reply");
    pollfd wait{from.file(), POLLIN, 0};
    if (::poll(&wait, 1, 100) <= 0) continue;
    char bytes[1 << 16];
    const ssize_t n = ::read(from.file(), bytes, sizeof bytes);
    if (n == 0) fail("ended");
    if (n > 0) received.append(bytes, static_cast<std::size_t>(n));
  }
}

// Its own messages in between are left out.
Json Chromium::Impl::ask(const char* method, Json parameters) {
  Json command{{"id", ++last}, {"method", method}, {"params", std::move(parameters)}};
  if (!session.empty()) command["sessionId"] = session;
  std::string text = command.text();
  text += '\0';
  if (!write_all(to.file(), text)) fail("ended");
  while (true) {
    Json answer;
    if (!Json::parse(next_message(), answer)) fail("sends text that is not JSON");
    if (!answer.contains("id") || answer["id"] != last) continue;
    if (answer.contains("error"))
      fail(fmt::format("refuses {}: {}", method, answer["error"].string("message", "")));
    return std::move(answer["result"]);
  }
}

Chromium::Chromium(const std::atomic<bool>& stop) : impl_(std::make_unique<Impl>(stop)) {
  impl_->start();
}

Chromium::~Chromium() = default;

const fs::path& Chromium::folder() const { return impl_->folder; }

void Chromium::open(const fs::path& page) {
  impl_->session.clear();
  const Json target = impl_->ask("Target.createTarget", {{"url", url_of(page)}});
  const Json attached =
      impl_->ask("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}});
  impl_->session = attached["sessionId"].string();
}

std::string Chromium::evaluate(std::string_view script) {
  const Json answer =
      impl_->ask("Runtime.evaluate",
                 {{"expression", script}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) {
    const Json& details = answer["exceptionDetails"];
    const Json* exception = details.find("exception");
    const std::string text = details.string("text", "");
    throw std::runtime_error(
        "the run's page met an error: " +
        (exception != nullptr ? exception->string("description", text) : text));
  }
  const Json& result = answer["result"];
  return result.contains("value") ? result["value"].text() : "null";
}

std::string Chromium::text(std::string_view script) {
  const Json value = Json::parse(evaluate(script));
  return value.is_string() ? value.string() : std::string();
}

}  // namespace sinew::film
