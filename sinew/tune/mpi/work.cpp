#include "sinew/tune/mpi/work.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "sinew/host/module.h"
#include "sinew/json/json.h"
#include "sinew/tune/mpi/module/messages.h"
#include "sinew/tune/results/request.h"

namespace sinew::tune {

namespace {

int number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}

// Returns whether there are several processes. mpirun of Open MPI sets their number, as does
// srun, which has it from PMIx.
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
  // All processes have the same error, and the first one reports it; then mpirun ends the others.
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

namespace {

// Messages are binary, which preserves the bytes of every cell.
//
//   to a worker     {"shares": […]}                request for the text of the worker's study; the
//                                                  shares of a sample that is handed out, if any
//                   {"points": [3, 4, 5]}          points to run
//                   {"end": true}
//   to the master   {"asked": "…"}                 text of the worker's study
//                   {"row": {…}}
//                   {"error": "…"}                 the worker cannot make the sweep
//                   {"end": true}                  the last message
std::string packed(const Json& message) { return message.bytes(); }

Json unpacked(const std::string& bytes) { return Json::of_bytes(bytes); }

Json json_of(const Row& row) {
  return {{"point", row.point},
          {"cells", row.cells},
          {"ok", row.ok},
          {"lacks", row.notes.lacks},
          {"differs", row.notes.differs},
          {"stop_reached", row.notes.stop_reached},
          {"no_air", row.notes.no_air},
          {"out_of_reach", row.notes.out_of_reach}};
}

Row row_of(const Json& json) {
  return {.point = json.at("point").natural(),
          .cells = json.at("cells").strings(),
          .ok = json.at("ok").boolean(),
          .notes = {.lacks = json.at("lacks").strings(),
                    .differs = json.at("differs").strings(),
                    .stop_reached = json.at("stop_reached").boolean(),
                    .no_air = json.at("no_air").boolean(),
                    .out_of_reach = json.at("out_of_reach").boolean()}};
}

constexpr double while_nothing_comes = 0.1;  // interval at which `stop` is polled [s]
constexpr std::size_t largest_part = 256;    // largest number of points handed out at a time

// Hands out points so that every worker has some in store until its next ones arrive.
class HandOut {
 public:
  HandOut(const Ranks& ranks, std::span<const std::size_t> points, const std::atomic<bool>* stop)
      : ranks_(ranks),
        points_(points),
        stop_(stop),
        open_(static_cast<std::size_t>(ranks.size()), 0) {}

  bool all_there() const { return running_ == 0 && (next_ == points_.size() || stopped()); }

  void give(int worker) {
    std::size_t& open = open_[static_cast<std::size_t>(worker)];
    while (next_ < points_.size() && !stopped() && open <= part() / 2) {
      const std::size_t count = std::min(part(), points_.size() - next_);
      const auto some = points_.subspan(next_, count);
      ranks_.send(worker, packed({{"points", std::vector(some.begin(), some.end())}}));
      next_ += count;
      open += count;
      running_ += count;
    }
  }

  void returned(int worker) {
    --open_[static_cast<std::size_t>(worker)];
    --running_;
  }

 private:
  bool stopped() const { return stop_ && stop_->load(); }

  // Returns the number of points to hand out: small near the end, so that all workers end together.
  std::size_t part() const {
    const auto workers = static_cast<std::size_t>(ranks_.size() - 1);
    return std::clamp<std::size_t>((points_.size() - next_) / (4 * workers), 1, largest_part);
  }

  const Ranks& ranks_;
  std::span<const std::size_t> points_;
  const std::atomic<bool>* stop_;
  std::vector<std::size_t> open_;  // number of points at each worker
  std::size_t next_ = 0, running_ = 0;
};

// Returns a worker's first reply.
Json begin(const std::function<Sweep()>& sweep, const std::vector<double>& shares,
           run::Device& device, std::unique_ptr<Runner>& runner) try {
  device = run::chosen(device);
  Sweep s = sweep();
  if (s.sample && s.sample->given_later) {
    s.sample->points = shares.size() / s.sample->ranges.size();
    s.sample->given = shares;
  }
  runner = std::make_unique<Runner>(s);
  return {{"asked", request_of(s).text}};
} catch (const std::exception& e) {
  return {{"error", e.what()}};
}

void require_same(const std::string& ours, const std::string& theirs, int rank) {
  if (ours == theirs) return;
  const Difference d = difference(theirs, ours);
  throw std::runtime_error(
      fmt::format("rank {} has another study, with \"{}\"; expected \"{}\"; try the same files on "
                  "every machine",
                  rank, d.first, d.second));
}

}  // namespace

decltype(Options::dispatch) Master::dispatcher(const Sweep& sweep, const std::atomic<bool>* stop) {
  if (ranks_.size() == 1) return {};
  const bool given_later = sweep.sample && sweep.sample->given_later;
  return [this, request = request_of(sweep).text,
          shares = given_later ? sweep.sample->given : std::vector<double>{},
          stop](std::span<const std::size_t> points, const std::function<void(Row)>& done) {
    run(request, shares, points, done, stop);
  };
}

void Master::run(const std::string& request, const std::vector<double>& shares,
                 std::span<const std::size_t> points, const std::function<void(Row)>& done,
                 const std::atomic<bool>* stop) {
  HandOut out(ranks_, points, stop);
  for (int worker = 1; worker < ranks_.size(); ++worker)
    ranks_.send(worker, packed({{"shares", shares}}));
  while (!out.all_there()) {
    const auto message = ranks_.receive(while_nothing_comes);
    if (!message) continue;
    const Json json = unpacked(message->text);
    if (json.contains("error"))
      throw std::runtime_error(
          fmt::format("rank {}: {}", message->from, json.at("error").string()));
    if (json.contains("asked")) {
      require_same(request, json.at("asked").string(), message->from);
    } else {
      out.returned(message->from);
      done(row_of(json.at("row")));
    }
    out.give(message->from);
  }
}

// Rows that arrive after an error are dropped; their points are run again the next time.
Master::~Master() {
  try {
    for (int worker = 1; worker < ranks_.size(); ++worker)
      ranks_.send(worker, packed({{"end", true}}));
    for (int left = ranks_.size() - 1; left > 0;) {
      const auto message = ranks_.receive(while_nothing_comes);
      left -= message && unpacked(message->text).contains("end") ? 1 : 0;
    }
  } catch (const std::exception&) {
    // The workers no longer exist.
  }
}

void work(const Ranks& ranks, const std::function<Sweep()>& sweep, int threads,
          run::Device device) {
  std::unique_ptr<Runner> runner;
  for (;;) {
    const auto message = ranks.receive(60);
    if (!message) continue;
    const Json json = unpacked(message->text);
    if (json.contains("end")) break;
    if (!json.contains("points")) {
      ranks.send(0, packed(begin(sweep, json.at("shares").numbers(), device, runner)));
      continue;
    }
    std::vector<std::size_t> points;
    for (const Json& point : json.at("points").list()) points.push_back(point.natural());
    const auto done = [&](const Row& row) { ranks.send(0, packed({{"row", json_of(row)}})); };
    try {
      runner->run(points, threads, done, device);
    } catch (const std::exception& e) {
      ranks.send(0, packed({{"error", e.what()}}));
    }
  }
  ranks.send(0, packed({{"end", true}}));
}

}  // namespace sinew::tune
