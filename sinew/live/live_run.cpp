#include "sinew/live/live_run.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <exception>
#include <map>
#include <thread>

#include "sinew/config/diagnostics.h"
#include "sinew/live/live_view.h"
#include "sinew/live/request.h"
#include "sinew/report/page/page.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/folder/page.h"

namespace sinew::live {

namespace {

// Returns the topics that pages show. A machine has no true values, so topics under /true are left
// out.
run::LoggedTopics shown_topics_of(const experiment::Experiment& e, bool simulated) {
  return run::logged_topics(run::topics(e), [simulated](const signals::Topic& topic) {
    return simulated || !topic.name.starts_with("/true/");
  });
}

// Passes samples to the log, if it has their topic, and to the feed.
struct Tee {
  run::Tap log;
  std::vector<std::uint16_t> logged;  // topic of the log by topic of the run, or not_tapped
  const std::vector<std::uint16_t>& shown;
  live::Feed& feed;

  static void push(void* self, std::uint16_t topic, std::int64_t time_ns,
                   std::span<const double> values) noexcept {
    const Tee& tee = *static_cast<Tee*>(self);
    if (tee.shown[topic] != run::not_tapped) tee.feed.push(tee.shown[topic], time_ns, values);
    if (tee.log.push && tee.logged[topic] != run::not_tapped)
      tee.log.push(tee.log.object, tee.logged[topic], time_ns, values);
  }
};

}  // namespace

class LiveRun::Impl {
 public:
  Impl(const run::RunRequest& request, LiveOptions options, run::Notices notices)
      : options_(std::move(options)),
        notices_(std::move(notices)),
        kept_(request, notices_),
        values_(kept_.values()),
        shown_(shown_topics_of(kept_.experiment(), !run::is_outside_simulation(request.port))),
        feed_(shown_.topics),
        view_(kept_.experiment(), values_, steering_, feed_, tick_, machine() ? &stop_ : nullptr,
              request.units),
        server_(
            options_.port,
            {.get = [this](std::string_view path) { return get(path); },
             .tick =
                 [this] {
                   feed_.collect();
                   if (!over()) view_.record_changes();
                 },
             .frame = [this](Server::SocketId w) { return frame(w); },
             .message = [this](Server::SocketId,
                               std::string_view text) { return over() ? "" : view_.handle(text); },
             .left = [this](Server::SocketId w) { positions_.erase(w); },
             .interrupted = [this] { interrupted(); },
             .signals = machine() ? std::vector{SIGQUIT, SIGTSTP} : std::vector<int>{}}) {
    steering_.pace(options_.pace);
    steering_.pause(options_.paused);
  }

  std::string url() const { return server_.url(); }

  bool machine() const noexcept { return kept_.place().board_keeps_time(); }
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }

  void go() {
    std::thread runner([this] { run(); });
    server_.run();
    runner.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  bool over() const { return over_.load(std::memory_order_acquire); }

  // Runs on a thread of its own. Only this thread writes the results that `over_` publishes.
  void run() {
    try {
      Tee tee{{}, {}, shown_.of_series, feed_};
      run::RunOptions o{.steering = &steering_, .progress = &tick_, .stop = &stop_};
      kept_.apply(o);
      tee.log = o.tap;
      tee.logged = std::move(o.tapped);
      o.tap = {&tee, &Tee::push};
      o.tapped.clear();
      for (std::size_t i = 0; i < shown_.of_series.size(); ++i)
        o.tapped.push_back(static_cast<std::uint16_t>(i));
      const auto kept = kept_.store(run::run(kept_.experiment(), o));
      if (options_.kept) options_.kept(kept);
      page_ = file_text(kept_.folder() / run::report_name);
    } catch (const std::exception& e) {
      failure_ = std::current_exception();
      words_ = e.what();
    }
    over_.store(true, std::memory_order_release);
    if (options_.once || ending_.load())
      server_.finish();
    else
      notices_.note("its page stays at " + server_.url() + " until Ctrl-C");
  }

  Reply get(std::string_view path) {
    if (path != "/")
      return {404, "Nothing is here; the run is at the address that was printed.\n", "text/plain"};
    if (!over())
      return {200, view_.page(fmt::format("127.0.0.1:{0} ws://localhost:{0}", server_.port()))};
    if (!page_.empty()) return {200, page_};
    return {200, failure_ ? words_ : "The run is over; it was to leave no page.\n",
            "text/plain; charset=utf-8"};
  }

  std::string frame(Server::SocketId socket) {
    PageState& w = positions_[socket];
    if (!over()) return view_.frame(w.position);
    if (w.is_end_sent) return "";
    w.is_end_sent = true;
    return "{\"over\":true}";
  }

  // Lets a simulation continue to its end at full speed, so that its files are complete, and stops
  // a machine. A second signal aborts.
  void interrupted() {
    if (over()) return server_.stop();
    const auto now = std::chrono::steady_clock::now();
    const bool first = !ending_.exchange(true);
    if (first) interrupted_at_ = now;
    // A window that closes sends several signals, so a machine is given 10 s to come to rest.
    if (!first && machine() && now - interrupted_at_ < std::chrono::seconds(10)) return;
    if (!first) {
      std::signal(SIGINT, SIG_DFL);
      std::raise(SIGINT);
    }
    if (machine()) {
      notices_.note("the machine is stopped");
      return stop();
    }
    notices_.note("the run goes to its end at full speed; Ctrl-C again breaks it off");
    steering_.pace(0);
    steering_.pause(false);
  }

  struct PageState {
    LiveView::Position position;
    bool is_end_sent = false;
  };

  const LiveOptions options_;
  const run::Notices notices_;
  run::RunStorage kept_;
  const config::Node values_;
  run::Steering steering_;
  const run::LoggedTopics shown_;
  Feed feed_;
  std::atomic<std::int64_t> tick_{0};
  std::atomic<bool> stop_{false};
  LiveView view_;
  std::map<Server::SocketId, PageState> positions_;
  std::chrono::steady_clock::time_point interrupted_at_;
  std::atomic<bool> over_{false}, ending_{false};

  // Written by the run's thread until `over_`.
  std::exception_ptr failure_;
  std::string page_, words_;

  Server server_;  // last, because its destructor uses the members above
};

namespace {

// Checks the page and the port before a folder is created.
void require_live(Port port) {
  report::require_page("sinew view");
  if (port.number > 0) Server(port, {});
}

}  // namespace

LiveRun::LiveRun(const run::RunRequest& request, LiveOptions options, run::Notices notices) {
  require_live(options.port);
  if (run::has_own_clock(request.port) && (options.paused || options.pace != 1))
    config::fail({request.experiment, 0, 0}, options.paused ? "paused" : "pace",
                 options.paused ? "true" : fmt::format("{}", options.pace),
                 "neither pause nor pace: the machine keeps its own time");
  impl_ = std::make_unique<Impl>(request, std::move(options), std::move(notices));
}

LiveRun::~LiveRun() = default;

std::string LiveRun::url() const { return impl_->url(); }

bool LiveRun::machine() const noexcept { return impl_->machine(); }

void LiveRun::stop() noexcept { impl_->stop(); }

void LiveRun::go() { impl_->go(); }

}  // namespace sinew::live
