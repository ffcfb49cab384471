#include "sinew/tune/mpi/ranks.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "sinew/host/module.h"
#include "sinew/tune/mpi/module/messages.h"

namespace sinew::tune {
namespace {

int number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}

// mpirun of Open MPI says how many there are, and so does srun, which has it from PMIx.
bool one_of_several() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE")) return number_in("OMPI_COMM_WORLD_SIZE") > 1;
  if (std::getenv("PMIX_RANK") && number_in("SLURM_STEP_NUM_TASKS") > 1) return true;
  if (number_in("PMI_SIZE") > 1)
    throw std::runtime_error(
        "started by the mpirun of another MPI; expected that of Open MPI; try mpirun.openmpi, or "
        "shards");
  return false;
}

[[noreturn]] void fail(const std::string& what) {
  // What all of them would say the first one says: then mpirun ends the others.
  if (number_in("OMPI_COMM_WORLD_RANK") > 0) std::this_thread::sleep_for(std::chrono::seconds(2));
  throw std::runtime_error(what);
}

void* module_with_mpi() {
  if (void* module = host::open_module("sinew_mpi.so")) return module;
  fail(
      "started by mpirun, and this program was built without MPI; try: apt-get install "
      "libopenmpi-dev, then cmake --preset release && cmake --build --preset all; or shards, which "
      "need none");
}

}  // namespace

Ranks::Ranks() {
  if (!one_of_several()) return;
  const auto messages = reinterpret_cast<const SinewMessages* (*)()>(
      host::function_of(module_with_mpi(), "sinew_messages_1"));
  if (!messages) fail("sinew_mpi.so is of another version of Sinew; build and install both again");
  if (!messages()->begin(&rank_, &size_)) fail("MPI cannot begin; its own words stand above");
  messages_ = messages();
}

Ranks::~Ranks() {
  if (messages_) messages_->end();
}

void Ranks::send(int to, std::string_view bytes) const {
  if (!messages_->send(to, bytes.data(), bytes.size()))
    throw std::runtime_error("rank " + std::to_string(to) + " cannot be reached any more");
}

std::optional<Ranks::Message> Ranks::receive(double seconds) const {
  Message out;
  std::size_t count = 0;
  if (!messages_->wait(seconds, &out.from, &count)) return std::nullopt;
  out.text.resize(count);
  if (!messages_->receive(out.from, out.text.data(), count))
    throw std::runtime_error("a message of rank " + std::to_string(out.from) + " was lost");
  return out;
}

}  // namespace sinew::tune
