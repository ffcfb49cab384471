#include "sinew/host/stop.h"

#include <utility>

namespace sinew::host {

namespace {
thread_local const std::atomic<bool>* current = nullptr;
}  // namespace

Stoppable::Stoppable(const std::atomic<bool>* stop) : before_(std::exchange(current, stop)) {}
Stoppable::~Stoppable() { current = before_; }
const std::atomic<bool>* Stoppable::flag() { return current; }

}  // namespace sinew::host
