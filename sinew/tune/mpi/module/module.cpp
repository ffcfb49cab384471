// The module with the MPI library in it.
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "sinew/tune/mpi/module/messages.h"

namespace {

constexpr int tag = 1;

// The threads of a worker send one at a time.
bool begin(int* rank, int* size) {
  int provided = 0;
  return MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) == MPI_SUCCESS &&
         provided >= MPI_THREAD_SERIALIZED && MPI_Comm_rank(MPI_COMM_WORLD, rank) == MPI_SUCCESS &&
         MPI_Comm_size(MPI_COMM_WORLD, size) == MPI_SUCCESS;
}

bool send(int to, const char* bytes, std::size_t count) {
  return MPI_Send(bytes, static_cast<int>(count), MPI_BYTE, to, tag, MPI_COMM_WORLD) == MPI_SUCCESS;
}

// Polls with pauses, since MPI's own waiting occupies a processor that the runs need.
bool wait(double seconds, int* from, std::size_t* count) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  auto pause = std::chrono::microseconds(20);
  for (;;) {
    int there = 0, bytes = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS)
      return false;
    if (there != 0) {
      MPI_Get_count(&status, MPI_BYTE, &bytes);
      *from = status.MPI_SOURCE;
      *count = static_cast<std::size_t>(bytes);
      return true;
    }
    if (Clock::now() >= until) return false;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(1000));
  }
}

bool receive(int from, char* bytes, std::size_t count) {
  return MPI_Recv(bytes, static_cast<int>(count), MPI_BYTE, from, tag, MPI_COMM_WORLD,
                  MPI_STATUS_IGNORE) == MPI_SUCCESS;
}

void end() { MPI_Finalize(); }

constexpr SinewMessages messages{begin, send, wait, receive, end};

}  // namespace

extern "C" const SinewMessages* sinew_messages_1() { return &messages; }
