// tune/mpi/work.h - a sweep over the processes of mpirun: the first one hands out points and takes
// the rows, all others run them.
//
//   Ranks ranks;
//   if (ranks.is_worker()) return work(ranks, [] { return the same sweep; }, threads);
//   Master master(ranks);  // before anything that can fail: it lets the workers go
//   sweep(s, {.elsewhere = master.elsewhere(s, &stop)});
//
// A point is its number and a row is a row, as for threads and shards, so a table does not follow
// from who made it. A row is sent as soon as its run is done. Open MPI ends all processes when one
// of them dies; what the first one has written by then is there, and the same command goes on.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "sinew/tune/sweep.h"

// This process among those that mpirun started.
//
// The MPI library is in a module of its own, which is opened here and nowhere else: a program that
// mpirun did not start neither needs nor loads it.

struct SinewMessages;

namespace sinew::tune {

// Holds which of the processes this one is, and passes texts between them.
class Ranks {
 public:
  // Joins the others where this process is one of several, else is alone. Throws std::runtime_error
  // where the module is missing or the others cannot be reached.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }  // from 0
  int size() const { return size_; }  // 1: alone
  // Is this another process than the first?
  bool is_worker() const { return rank_ > 0; }

  // Holds what another process has sent.
  struct Message {
    int from = 0;
    std::string text;
  };

  // Throws std::runtime_error.
  void send(int to, std::string_view bytes) const;
  std::optional<Message> receive(double seconds) const;  // waits that long

 private:
  const SinewMessages* messages_ = nullptr;
  int rank_ = 0, size_ = 1;
};

}  // namespace sinew::tune

namespace sinew::tune {

// Hands out a sweep's points to the other processes.
class Master {
 public:
  // `ranks` outlives it.
  explicit Master(const Ranks& ranks) : ranks_(ranks) {}

  // Lets the workers go.
  ~Master();
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  // Returns what Options::elsewhere wants; nothing where this process is alone. It throws
  // std::runtime_error where a worker has another sweep, as of other files under the same names.
  decltype(Options::elsewhere) elsewhere(const Sweep& sweep, const std::atomic<bool>* stop);

 private:
  void run(const std::string& asked, const std::vector<double>& shares,
           std::span<const std::size_t> points, const std::function<void(Row)>& done,
           const std::atomic<bool>* stop);

  const Ranks& ranks_;
};

// Runs what it is given until it is let go. `sweep` is called when there is something to be done.
void work(const Ranks& ranks, const std::function<Sweep()>& sweep, int threads);

}  // namespace sinew::tune
