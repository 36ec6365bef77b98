// The faults at work: what they make of bytes and lines that pass, and what they do to the printer and when.
// Every fault has a stream of chance of its own, so a run with the same seed and the same bytes is the same
// run, and one fault more changes nothing of the others.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "sim/faults/fault.hpp"
#include "sim/line/line_check.hpp"
#include "sim/line/wire.hpp"

namespace unicursal::sim {

class Faults {
 public:
  explicit Faults(const FaultPlan& plan = {});

  /// What arrives of bytes that the computer sends. A byte that follows a lost one is marked as damaged.
  std::vector<WireByte> to_printer(std::string_view bytes);
  /// What the printer really says instead of this line; newlines included.
  std::string from_printer(std::string_view line);
  /// By how many seconds a reply is late.
  double delay();
  /// A complete line has been received; what the firmware takes it for.
  Misreading received(std::string_view line);

  /// When the next fault with a time strikes.
  std::optional<double> next_time() const;
  /// Those that are to be done to the printer now.
  std::vector<Fault> due(double now);

  /// How often each has struck, by name.
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

 private:
  struct Armed {
    Fault fault;
    std::mt19937_64 chance;
    std::uint64_t pending = 0;  ///< moments that have come and not struck yet
    bool past = false;          ///< its time has come, or its line
  };

  bool strikes(FaultKind kind);
  bool strikes(Armed& armed);
  void arm(Armed& armed);
  std::string misspelt_ok();
  std::optional<std::string> other_ok();
  std::string before_reply();
  std::string noise();
  std::string damaged(std::string text);
  void damage_byte(WireByte byte, std::vector<WireByte>& bytes);

  std::vector<Armed> armed_;
  std::vector<Fault> events_;  ///< struck by a line, not yet done
  std::map<std::string, std::uint64_t> counts_;
  std::mt19937_64 details_;  ///< which bit, which text
  bool gap_ = false;         ///< a byte to the printer was lost just now
};

}  // namespace unicursal::sim
