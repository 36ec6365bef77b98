// Interruptions of a print: pauses, waits for something that is missing, and changes of temperature, speed
// and flow. The print calls between_batches() and wait_for(); commands only leave marks for them. s, °C. It
// belongs to the loop's thread.
//
// A pause ends a segment: the printer finishes what it has, the filament is drawn back in equal shares, the
// nozzle rises and goes aside (firmware_gcode/interruption/pause.hpp). Then the next line follows: none is
// lost, none is run twice. Meanwhile M85 is kept fresh, so that the firmware cools the printer if this
// program dies, and the nozzle cools if nobody comes for long. A nozzle that has had nothing to do for some
// seconds, because the disk is full or planning has fallen behind, goes aside in the same way until it can go
// on.
#pragma once

#include <asio/awaitable.hpp>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "firmware_gcode/interruption/pause.hpp"
#include "host/engine/announcer.hpp"
#include "host/engine/intent.hpp"
#include "host/engine/place_keeper.hpp"
#include "host/engine/printer_view.hpp"
#include "host/engine/progress.hpp"
#include "host/engine/session_types.hpp"
#include "host/engine/source.hpp"
#include "host/loop/signal.hpp"

namespace unicursal::host {

// Answers to commands.
constexpr auto pause_when_hot = "the print pauses as soon as the printer is hot";
constexpr auto ends_already = "the print is ending";

/// Something that the print cannot go on without, and may have to wait for.
struct Need {
  std::string why;             ///< the reason for the waiting, a sentence
  std::function<bool()> come;  ///< whether it is there
  /// Looks for it now and then; empty if its coming wakes the session.
  std::function<asio::awaitable<void>()> look;
  TimePoint at = TimePoint::max();  ///< when it will be there, in virtual time
  bool at_work = false;             ///< this computer is busy with it: virtual time stands still
};

class Holding {
 public:
  /// What a session lends to its parts; all of it must outlive them.
  struct Parts {
    Link& link;
    Signal& wake;  ///< notified after every change that somebody may wait for
    Source& source;
    const StreamSettings& settings;
    PlaceKeeper& places;
    PrinterView& printer;
    Announcer& announcer;
    Intent& intent;
    const Progress& progress;
  };

  explicit Holding(Parts parts) : parts_(parts) {}

  // ---- for the print

  /// Does all that was asked for since the last batch; a pause is over when this returns. Throws LinkError.
  asio::awaitable<void> between_batches();
  /// Returns when `need` has come or the print is to end. The nozzle is not left on the part for long. Throws
  /// LinkError.
  asio::awaitable<void> wait_for(const Need& need);
  /// Switches the printer's filament sensor on again if a resume has switched it off. Throws LinkError.
  asio::awaitable<void> guard_again();
  /// Times that the print was held.
  std::size_t pauses() const { return pauses_; }

  // ---- commands; they return at once

  Refusal pause(const std::string& reason);
  Refusal resume();
  /// Presses a button of the question that the printer asks, counted from 0.
  Refusal answer(std::size_t button);
  /// A G-code line for the printer; while it heats, the printer reads it only afterwards.
  Refusal change(const std::string& line);
  /// The printer does not lay what it is sent, or is about to: the print is held and a person is called.
  /// `reason`: a sentence with the remedy. `cool`: the nozzle is not kept hot meanwhile.
  void pause_for_fault(const std::string& reason, bool cool = false);
  /// The printer asks for a pause, or has paused itself (`by`).
  void pause_for_printer(const std::string& reason, PausedBy by);
  /// The printer asks for the end of a pause. No effect unless there is one.
  void resume_for_printer();
  /// The printer reports that it waits for a person, or asks one.
  void printer_waits();
  /// Ends a pause in mid-heating, which the printer's own wait has caused, when that wait has ended.
  void look_for_person();

 private:
  asio::awaitable<void> make_changes(bool drawn);
  bool can_change(const std::string& line, bool drawn) const;
  bool change_due(bool drawn) const;
  asio::awaitable<void> hold();
  asio::awaitable<bool> wait_held(bool aside);
  asio::awaitable<bool> look_after_firmware();
  asio::awaitable<void> go_aside(std::string why, bool moving);
  asio::awaitable<void> come_back(bool moving);
  asio::awaitable<void> heat_again();
  asio::awaitable<void> stay_aside(bool moved);
  asio::awaitable<void> wait_aside(const Need& need);
  void end_pause();
  void let_printer_go_on();
  void report_position();
  gcode::Pause pause_here() const;
  bool over() const;
  TimePoint now() const { return parts_.settings.clock->now(); }

  Parts parts_;
  std::deque<std::string> changes_;         ///< lines that were asked for, to be interposed
  TimePoint hot_until_ = TimePoint::max();  ///< a nozzle that stands aside is cooled from then on
  bool waits_aside_ = false;                ///< the nozzle stands aside since something is missing
  std::vector<std::string> way_aside_;      ///< lines that have led the nozzle away in a pause, and back
  bool cooled_ = false;                     ///< the nozzle was cooled while the print was held
  bool unguarded_ = false;                  ///< the printer's filament sensor was switched off
  bool waited_ = false;                     ///< in this pause the printer has said that it waits
  TimePoint wait_began_{};                  ///< when it said so first
  TimePoint waits_until_{};                 ///< until then it may still be in its own wait
  bool cool_soon_ = false;                  ///< it is not kept hot in the next pause
  std::size_t pauses_ = 0;
};

}  // namespace unicursal::host
