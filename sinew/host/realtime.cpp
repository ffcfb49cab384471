#include "sinew/host/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace sinew::host {

namespace {

bool schedule(int policy, int with) noexcept {
  const sched_param wanted{.sched_priority = with};
  return ::pthread_setschedparam(::pthread_self(), policy, &wanted) == 0;
}

}  // namespace

// Pages that come later are left as they are: locked from the start they would count against a
// limit that a run's log may well exceed.
RealTime::RealTime() noexcept
    : first_(schedule(SCHED_FIFO, priority)), locked_(::mlockall(MCL_CURRENT) == 0) {}

RealTime::~RealTime() {
  if (locked_) (void)::munlockall();
  if (first_) (void)schedule(SCHED_OTHER, 0);
}

std::vector<std::string> problems(const RealTime& real_time) {
  std::vector<std::string> out;
  if (!real_time.first())
    out.emplace_back(
        "SCHED_FIFO is not permitted: other programs may come before the loop; for the group "
        "iocard: echo '@iocard - rtprio 90' | sudo tee /etc/security/limits.d/sinew.conf, then log "
        "in again");
  if (!real_time.locked())
    out.emplace_back(
        "memory cannot be locked: a page that was put out costs milliseconds; for the group "
        "iocard: echo '@iocard - memlock unlimited' | sudo tee -a "
        "/etc/security/limits.d/sinew.conf, then log in again");
  return out;
}

}  // namespace sinew::host
