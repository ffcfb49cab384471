// tune/mpi/work.h - a sweep over the processes of mpirun: the first process hands out points and
// collects the rows, all others run the points.
//
//   Ranks ranks;
//   if (ranks.is_worker()) return work(ranks, [] { return the same sweep; }, threads);
//   Master master(ranks);  // before anything that can fail: its destructor releases the workers
//   sweep(s, {.dispatch = master.dispatcher(s, &stop)});
//
// A row depends on its point's number only, as for threads and shards, so a table does not depend
// on the process that made each row. A row is sent as soon as its run is done. Open MPI ends all
// processes if one of them dies; the rows that the first one has written remain, and the same
// command continues.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "sinew/tune/sweep.h"

// This process among those that mpirun started.
//
// The MPI library is in a separate module, which only this class opens: a program that mpirun did
// not start neither needs nor loads it.

struct SinewMessages;

namespace sinew::tune {

// The rank of this process, and messages between processes.
class Ranks {
 public:
  // Joins the others if this process is one of several. Throws std::runtime_error if the module is
  // missing or the others cannot be reached.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }  // counted from 0
  int size() const { return size_; }  // 1: alone
  // Returns whether this process is not the first.
  bool is_worker() const { return rank_ > 0; }

  // A message received from another process.
  struct Message {
    int from = 0;
    std::string text;
  };

  // Throws std::runtime_error, as does receive().
  void send(int to, std::string_view bytes) const;
  std::optional<Message> receive(double seconds) const;  // waits at most that long

 private:
  const SinewMessages* messages_ = nullptr;
  int rank_ = 0, size_ = 1;
};

}  // namespace sinew::tune

namespace sinew::tune {

// Hands out a sweep's points to the other processes.
class Master {
 public:
  // `ranks` must outlive it.
  explicit Master(const Ranks& ranks) : ranks_(ranks) {}

  // Returns whether no other process was started.
  bool is_alone() const { return ranks_.size() == 1; }

  // Releases the workers.
  ~Master();
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  // Returns a function for Options::dispatch, or an empty one if this process is alone. The
  // function throws std::runtime_error if a worker has another sweep, for example other
  // files of the same names.
  decltype(Options::dispatch) dispatcher(const Sweep& sweep, const std::atomic<bool>* stop);

 private:
  void run(const std::string& request, const std::vector<double>& shares,
           std::span<const std::size_t> points, const std::function<void(Row)>& done,
           const std::atomic<bool>* stop);

  const Ranks& ranks_;
};

// Runs points until the master releases this worker. `sweep` is called when there are points to
// run. A card that cannot be used is the master's error.
void work(const Ranks& ranks, const std::function<Sweep()>& sweep, int threads,
          run::Device device = {});

}  // namespace sinew::tune
