// A printer on a test bench: lines in, replies and executed moves out; the test controls the clock.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/firmware/repetier.hpp"

namespace unicursal::sim {

struct MoveList : MoveSink {
  std::vector<ExecutedMove> moves;
  void moved(const ExecutedMove& move) override { moves.push_back(move); }
};

struct Bench {
  using Replies = std::vector<std::string>;

  explicit Bench(const Machine& machine = {}, std::string_view who = "marlin")
      : made(make_firmware(machine, personality(who), sink,
                           [this](std::string_view line) { replies.emplace_back(line); })) {}
  explicit Bench(std::string_view who) : Bench(Machine{}, who) {}

  /// Sends one line with its newline; returns what the printer answers without time passing.
  Replies send(const std::string& line) {
    replies.clear();
    firmware.receive(line + "\n");
    return replies;
  }
  /// The same, with a line number and a correct checksum.
  Replies send(std::int64_t number, const std::string& command) { return send(numbered(number, command)); }
  /// Sends a line and waits until the command is done, as a host of a leaping printer does.
  Replies finish(const std::string& line) {
    send(line);
    leap();
    return replies;
  }
  void leap() {
    while (firmware.blocked()) firmware.advance(*firmware.next_event());
  }
  void heat() {
    finish("M109 S210");
    replies.clear();
  }

  static std::string numbered(std::int64_t number, const std::string& command) {
    const std::string line = fmt::format("N{} {}", number, command);
    return fmt::format("{}*{}", line, checksum(line));
  }

  MoveList sink;
  Replies replies;
  std::unique_ptr<Firmware> made;
  Firmware& firmware = *made;
};

}  // namespace unicursal::sim
