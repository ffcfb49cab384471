// control/board/test_host.h - a host on a line without delay, and a board whose sensors a test
// controls.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "sinew/control/board/program.h"
#include "sinew/control/link/test_wire.h"
#include "sinew/control/supervise/test_stand.h"

namespace sinew::board {

using control::BoardFault;
using control::BoardState;
using link::Bytes;
using link::Code;
using signals::Tick;

inline link::Configuration leg_configuration() {
  return {control::test_leg(), control::limits(), {}};
}

struct NoTicks {
  void block() noexcept {}
  void allow() noexcept {}
};

struct Bench {
  explicit Bench(const Identification& who = {.nonce = 77}) : program(who) {}

  // --- the line ---

  template <class M>
  void send(const M& message) {
    Bytes frame = link::frame_of(message, {1, sequence++});
    if (spoil) spoil(frame);
    put(frame);
  }
  void put(const Bytes& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      done += program.receive(std::span(bytes).subspan(done));
      serve();
    }
  }
  void serve() {
    while (program.serve(NoTicks{})) listen();
    listen();
  }
  void listen() {
    std::array<std::uint8_t, 300> buffer;
    for (std::size_t n; (n = program.transmit(buffer)) > 0;) {
      std::span<const std::uint8_t> left(buffer.data(), n);
      received_bytes.insert(received_bytes.end(), left.begin(), left.end());
      while (!left.empty()) {
        left = left.subspan(decoder.push(left));
        while (const link::Frame* f = decoder.next()) receive_frame(*f);
      }
    }
  }
  void receive_frame(const link::Frame& f) {
    if (link::Reply m; link::decode(f, m) == Code::done) replies.push_back(m);
    if (link::Identity m; link::decode(f, m) == Code::done) identities.push_back(m);
    if (link::Event m; link::decode(f, m) == Code::done) events.push_back(m);
    if (link::Edges m; link::decode(f, m) == Code::done)
      for (std::size_t i = 0; i < m.count; ++i)
        edges.push_back({m.tick + m.edge[i].offset, {m.edge[i].valve}, m.edge[i].open});
    if (link::FaultLog m; link::decode(f, m) == Code::done) log.push_back(m);
    if (link::Readings m; link::decode(f, m) == Code::done && m.of.parts == 1)
      readings.push_back(m);
    if (const link::Telemetry* t = joiner.take(f.type, f.body)) {
      telemetry = *t;
      ++telemetries;
      if (on_telemetry) on_telemetry(*t);
    }
  }
  Code last() const { return replies.empty() ? Code::type : replies.back().code; }

  // --- the board ---

  void tick() {
    out = program.begin_tick([&] {
      serve();
      if (on_period) on_period();
    });
    if (const signals::Conversion* c = program.due()) {
      const std::uint8_t channel = c->channel.index;
      signals::Reading r{control::Stand::rest(channel), signals::Status::ok};
      if (reads) r = reads(channel, program.safety().run_tick(program.now()), r);
      program.take(*c, r);
    }
    feed = program.end_tick();
    serve();
  }
  void run(Tick ticks) {
    for (; ticks > 0; --ticks) tick();
  }
  bool reaches(BoardState state, Tick ticks) {
    for (; ticks > 0 && program.safety().state() != state; --ticks) tick();
    return program.safety().state() == state;
  }

  void configure(const link::Configuration& configuration) {
    const link::ConfigurationSender sender(configuration);
    ASSERT_TRUE(sender.ok());
    crc = sender.crc();
    send(sender.begin());
    for (std::size_t i = 0; i < sender.chunks; ++i) send(sender.chunk(i));
    send(sender.end());
  }
  void arm() {
    send(link::ArmFirst{crc});
    send(link::ArmSecond{replies.back().value, crc});
  }
  // Runs from power-up to an armed board.
  void ready(const link::Configuration& configuration = leg_configuration()) {
    configure(configuration);
    ASSERT_EQ(last(), Code::done);
    run(200);
    send(link::ClearFault{});
    ASSERT_EQ(last(), Code::done);
    run(1'100);
    arm();
    ASSERT_EQ(program.safety().state(), BoardState::armed);
  }

  Program program;
  Outputs out;
  bool feed = false;
  std::uint8_t sequence = 0;
  std::uint32_t crc = 0;
  std::function<void(Bytes&)> spoil;  // changes a frame on its way to the board
  std::function<signals::Reading(std::uint8_t channel, Tick run, signals::Reading)> reads;
  std::function<void()> on_period;
  std::function<void(const link::Telemetry&)> on_telemetry;

  link::Decoder decoder;
  link::TelemetryJoiner joiner{100};
  Bytes received_bytes;
  std::vector<link::Reply> replies;
  std::vector<link::Identity> identities;
  std::vector<link::Event> events;
  std::vector<signals::Edge> edges;
  std::vector<link::FaultLog> log;
  std::vector<link::Readings> readings;
  link::Telemetry telemetry;
  int telemetries = 0;
};

inline link::CommandFor command_of(const control::Command& command, Tick from,
                                   std::uint8_t joints = 3, std::uint8_t periods = 1) {
  return {.from = from, .periods = periods, .joints = joints, .joint = command.joint};
}

}  // namespace sinew::board
