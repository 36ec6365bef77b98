// The lines at hand that move the printer, with what they lay and how long they take, and from these the
// place of the nozzle: what the printer executes is not the last line that was sent, but lies behind by the
// moves in its queue.
//
// A printer acknowledges a move when it enters its queue. With ADVANCED_OK it reports how many are in there.
// Otherwise the time since the last look passes along the moves, within two bounds: not beyond what was
// acknowledged, and not farther behind it than the longest queue. The error is then a move or two while the
// queue is full, and at most the whole queue (15 moves in Marlin) while it fills or runs empty. mm, mm³, s.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "core/numeric/vec2.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "host/engine/line_follower.hpp"
#include "host/loop/clock.hpp"

namespace unicursal::host {

struct LineStep {
  static constexpr std::uint32_t no_layer = ~std::uint32_t{0};

  std::uint64_t line = 0;
  std::uint32_t layer = no_layer;
  std::uint32_t first_bead = 0, beads = 0;  ///< of the layer
  float x = 0, y = 0, z = 0;                ///< where it ends
  float seconds = 0;
  std::uint16_t fed = 0;  ///< number of the mixture that is fed along beads
  bool lays = false;
  float volume = 0;   ///< mm³ that leave the nozzle
  double poured = 0;  ///< mm³ from the first line to its end
  double end = 0;     ///< s from the first line to its end
};

class LineTable {
 public:
  /// `longest_queue`: moves that the printer's queue takes.
  explicit LineTable(std::size_t longest_queue) : longest_queue_(longest_queue) {}

  /// `volume` of these shares leaves the nozzle.
  void leave(double volume, const gcode::Shares& shares);
  double poured() const { return poured_; }
  void add(LineStep step);
  /// Forgets the lines from `line` on, and what has left behind `poured`.
  void back_to(std::uint64_t line, double poured);
  /// The lines from `line` on take `factor` times as long as was thought.
  void stretch(std::uint64_t line, double factor);
  /// Forgets lines before `line`, except the last few.
  void drop_before(std::uint64_t line);
  /// s of the lines from `line` on.
  double seconds_from(std::uint64_t line) const;
  /// Whether no step behind `line` was dropped.
  bool holds(std::uint64_t line) const { return dropped_ < line || dropped_ == 0; }

  struct Where {
    const LineStep* step = nullptr;
    const LineStep* before = nullptr;  ///< null if unknown
    double part = 1;                   ///< of the step that is done
  };
  /// Where the nozzle is. Absent if no line moves it yet. `speed`: M220, per cent.
  std::optional<Where> look(const LinePlace& place, TimePoint now, double speed);

  /// The mixture that leaves the nozzle there. Precondition: a printer of so many feeders.
  gcode::Shares leaving(const Where& where, std::size_t feeders) const;

  struct Change {
    double seconds = 0;
    std::uint16_t fed = 0;
  };
  /// The next bead of another mixture than that of the step where the nozzle is, after look(); absent: none
  /// is known.
  std::optional<Change> next_change(double speed) const;

 private:
  std::size_t at(std::uint64_t line) const;
  double begin_of(std::size_t index) const;
  std::size_t at_time() const;

  /// A piece of plastic.
  struct Poured {
    double middle = 0;                                        ///< mm³ from the first line to its middle
    std::array<std::uint16_t, gcode::most_feeders> shares{};  ///< × 65535
  };

  const std::size_t longest_queue_;
  std::deque<Poured> pieces_;
  double poured_ = 0;
  std::deque<LineStep> steps_;
  double before_ = 0;                  ///< end of the step before the first one
  std::uint64_t dropped_ = 0;          ///< the last line that was dropped
  std::deque<std::uint64_t> changes_;  ///< lines whose bead is the first of a mixture
  std::optional<std::uint16_t> last_fed_;
  double time_ = 0;  ///< where the nozzle is
  std::optional<TimePoint> looked_;
  std::uint64_t acknowledged_ = 0;
  std::optional<std::uint32_t> queued_;
};

}  // namespace unicursal::host
