// live/live_run.h - a run that is watched and steered from pages while it goes, and kept.
//
// The run has a thread of its own, those who watch are on the caller's. Between them stand feed and
// steering alone, so that the loop waits for nobody.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sinew/analysis/record/machine.h"
#include "sinew/live/port.h"
#include "sinew/run/folder/kept_run.h"

namespace sinew::live {

struct LiveOptions {
  Port port = {};       // on 127.0.0.1
  double pace = 1;      // simulated seconds per second of wall time; 0: no limit
  bool paused = false;  // the run waits for a page's button
  bool once = false;    // end with the run; else its page stays until Ctrl-C

  // Called on the run's thread with what it left, before its page is that of a run that is over.
  std::function<void(const run::Kept&)> kept = {};
};

class LiveRun {
 public:
  // Loads the experiment, opens its folder and listens. Throws config::Error for what cannot be run
  // or kept, or a machine that is to be paused or to have a pace, std::runtime_error where the port
  // is taken or the library was built without its page.
  LiveRun(const run::RunRequest& request, LiveOptions options, run::Notices notices = {});
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  std::string url() const;  // where its page is, with the token

  // Runs, and serves until the end. Ctrl-C, SIGTERM or a terminal that closes brings a simulation
  // to its end at full speed, so that what it leaves is whole, and stops a machine at once; a
  // second one breaks it off. Throws what the run or its keeping throws.
  void go();

  // Is it a machine that keeps its own time? Then stop() vents it; any thread may call.
  bool machine() const noexcept;
  void stop() noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sinew::live
