// Applies the faults of a plan: changes the bytes and lines that pass, and reports what happens to the
// printer and when. Every fault has a random stream of its own: the same seed and the same bytes give the
// same run, and an additional fault does not change the others.
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

  /// Returns what arrives of the bytes that the computer sends. A byte after a lost one is marked as damaged.
  std::vector<WireByte> to_printer(std::string_view bytes);
  /// Returns what the printer says instead of this line, newlines included.
  std::string from_printer(std::string_view line);
  /// Returns the delay of a reply, s.
  double delay();
  /// To be called for every complete line that is received. Returns the firmware's error with this line.
  Misreading received(std::string_view line);

  /// The time of the next fault with a time; nullopt if there is none.
  std::optional<double> next_time() const;
  /// Returns the faults that strike the printer now.
  std::vector<Fault> due(double now);
  /// The time that the board takes to boot, s; nullopt if no fault changes it.
  std::optional<double> boot_seconds() const;
  /// The faults that make commands take longer.
  std::vector<Fault> long_works() const;

  /// How often each kind has struck, by name.
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

 private:
  struct Armed {
    Fault fault;
    std::mt19937_64 chance;
    std::uint64_t pending = 0;  ///< Moments that have come, but have not struck yet.
    bool past = false;          ///< Whether its time or line has come.
  };

  bool strikes(FaultKind kind);
  bool strikes(Armed& armed);
  void arm(Armed& armed);
  std::string misspelt_ok();
  std::optional<std::string> other_ok();
  std::string before_reply();
  std::string behind_report(bool ok);
  std::string noise();
  std::string damaged(std::string text);
  void damage_byte(WireByte byte, std::vector<WireByte>& bytes);

  std::vector<Armed> armed_;
  std::vector<Fault> events_;  ///< Armed by a line or a time, not yet returned by due().
  std::map<std::string, std::uint64_t> counts_;
  std::mt19937_64 details_;  ///< Chooses bits and texts.
  bool gap_ = false;         ///< Whether the last byte to the printer was lost.
  std::string unfinished_;   ///< A report that has lost its newline, as long as no other line has come.
};

}  // namespace unicursal::sim
