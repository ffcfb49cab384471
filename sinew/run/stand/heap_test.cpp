// Once a run on the stand is set up, its loop takes no memory.
#include <gtest/gtest.h>

#include <string>

#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/loop.h"
#include "sinew/run/stand/recorder.h"
#include "tests/counted_heap.h"
#include "tests/places.h"

namespace sinew::rig::heap_test {
namespace {

using test::allocations;
using test::counting;

TEST(RigRun, TakesNoMemoryInItsLoop) {
  const std::string folder = sinew::test::source_dir() + "/experiments/rig/";
  for (const char* name : {"feedback.toml", "feed-forward.toml", "pwm-25hz-15lb.toml",
                           "pressure-steps.toml", "trapped-60-6.toml"}) {
    const Experiment e = load(folder + name);
    const signals::Tick end = 20000;
    plant::Stand stand(setup_of(e));
    Controller controller(e, end);
    Wishes wishes(e);
    Recorder recorder(e, controller, stand, end, false);
    run::SimulatedClock clock;
    allocations = 0;
    counting = true;
    const signals::Status status = run::loop(controller, wishes, stand, clock, recorder, end);
    counting = false;
    EXPECT_EQ(status, signals::Status::ok) << name;
    EXPECT_EQ(allocations, 0) << name;
    EXPECT_EQ(recorder.take().column("/true/stand/length")->size(), 2000u) << name;
  }
  // The counter counts.
  counting = true;
  ::operator delete(::operator new(1));
  counting = false;
  EXPECT_EQ(allocations, 1);
}

}  // namespace
}  // namespace sinew::rig::heap_test
