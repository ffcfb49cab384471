// live/live_run.h - a run that is observed and controlled by pages, and stored.
//
// The run has a thread of its own, the server uses the caller's. They are connected only by feed
// and steering, so that the loop never waits.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sinew/analysis/record/machine.h"
#include "sinew/live/server.h"
#include "sinew/run/folder/run_storage.h"

namespace sinew::live {

struct LiveOptions {
  Port port = {};       // on 127.0.0.1
  double pace = 1;      // simulated seconds per second of wall time; 0: no limit
  bool paused = false;  // the run starts when a page's button is pressed
  bool once = false;    // end with the run; otherwise the page is served until Ctrl-C

  // Called on the run's thread with the stored run, before the page of the finished run is served.
  std::function<void(const run::StoredRun&)> kept = {};
};

class LiveRun {
 public:
  // Loads the experiment, opens its folder and listens. Throws config::Error if it cannot be run or
  // stored, or for a pause or a pace of a machine that keeps its own time; std::runtime_error if
  // the port is taken or the library was built without its page.
  LiveRun(const run::RunRequest& request, LiveOptions options, run::Notices notices = {});
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  std::string url() const;  // address of the page, with the token

  // Runs, and serves until the end. After Ctrl-C, SIGTERM or the end of the terminal a simulation
  // continues to its end at full speed, so that its files are complete, and a machine is stopped at
  // once; a second signal aborts. Throws the exceptions of the run and of its storage.
  void go();

  // Returns whether this is a machine that keeps its own time. Then stop() vents it, from any
  // thread.
  bool machine() const noexcept;
  void stop() noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sinew::live
