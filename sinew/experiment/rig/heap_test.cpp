// Once a run on the stand is set up, its loop takes no memory.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string>

#include "sinew/experiment/clock.h"
#include "sinew/experiment/loop.h"
#include "sinew/experiment/rig/recorder.h"

namespace {

thread_local bool counting = false;
thread_local int taken = 0;

}  // namespace

// Not inlined: GCC would see malloc and delete meet, and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  taken += counting ? 1 : 0;
  if (void* p = std::malloc(size + 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  taken += counting ? 1 : 0;
  return std::malloc(size + 1);
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace sinew::rig {
namespace {

TEST(RigRun, TakesNoMemoryInItsLoop) {
  const std::string folder = std::string(SINEW_SOURCE_DIR) + "/experiments/rig/";
  for (const char* name : {"feedback.toml", "feed-forward.toml", "pwm-25hz-15lb.toml",
                           "pressure-steps.toml", "trapped-60-6.toml"}) {
    const Experiment e = load(folder + name);
    const signals::Tick end = 20000;
    plant::Stand stand(setup_of(e));
    Controller controller(e, end);
    Wishes wishes(e);
    Recorder recorder(e, controller, stand, end, false);
    experiment::SimulatedClock clock;
    taken = 0;
    counting = true;
    const signals::Status status =
        experiment::loop(controller, wishes, stand, clock, recorder, end);
    counting = false;
    EXPECT_EQ(status, signals::Status::ok) << name;
    EXPECT_EQ(taken, 0) << name;
    EXPECT_EQ(recorder.take().column("/true/stand/length")->size(), 2000u) << name;
  }
  // The counter counts.
  counting = true;
  ::operator delete(::operator new(1));
  counting = false;
  EXPECT_EQ(taken, 1);
}

}  // namespace
}  // namespace sinew::rig
