// tune/mpi/ranks.h - this process among those that mpirun started.
//
// The MPI library is in a module of its own, which is opened here and nowhere else: a program that
// mpirun did not start neither needs nor loads it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

struct SinewMessages;

namespace sinew::tune {

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
