// The state that a print should take next: it prints, is held, or ends. Commands and the printer change the
// intent; the print reads it between two batches of lines and while it waits. It belongs to the loop's
// thread.
//
//   printing ── pause() ──▶ paused ── resume() ──▶ resuming ── end_pause() ──▶ printing
//       any of these ── stop() ──▶ stopped;  any at all ── abort() ──▶ aborted
#pragma once

#include <string>
#include <utility>

namespace unicursal::host {

/// Who holds the printer during a pause.
enum class PausedBy {
  session,  ///< the session takes the nozzle aside and back
  firmware  ///< the firmware parks and returns by itself; the session only sends nothing
};

class Intent {
 public:
  bool printing() const { return kind_ == Kind::printing; }
  /// A pause was asked for, is in force, or is about to end.
  bool pausing() const { return kind_ == Kind::paused || kind_ == Kind::resuming; }
  /// A pause was asked for, and nobody has ended it yet.
  bool paused() const { return kind_ == Kind::paused; }
  /// The same, and the session holds the printer.
  bool paused_by_session() const { return paused() && by_ == PausedBy::session; }
  bool paused_by_firmware() const { return pausing() && by_ == PausedBy::firmware; }
  /// The rest of the print is not to be sent.
  bool ends() const { return stopped() || aborted(); }
  /// The printer is to be parked and cooled.
  bool stopped() const { return kind_ == Kind::stopped; }
  /// An emergency stop was sent to the printer.
  bool aborted() const { return kind_ == Kind::aborted; }
  /// Why it is held or stopped, a sentence; empty otherwise.
  const std::string& reason() const { return reason_; }

  /// No effect unless it prints.
  void pause(std::string reason, PausedBy by = PausedBy::session) {
    if (printing()) *this = Intent(Kind::paused, std::move(reason), by);
  }
  /// The pause ends as soon as it has been carried out. No effect unless it is paused.
  void resume() {
    if (paused()) kind_ = Kind::resuming;
  }
  /// The pause is over, or is not wanted any more. No effect on a print that ends.
  void end_pause() {
    if (pausing()) *this = Intent();
  }
  /// The session takes the printer aside itself, since the firmware has not parked or does not wait.
  void take_over() {
    if (paused()) by_ = PausedBy::session;
  }
  void stop(std::string reason) {
    if (!ends()) *this = Intent(Kind::stopped, std::move(reason), PausedBy::session);
  }
  void abort() { *this = Intent(Kind::aborted, {}, PausedBy::session); }

  Intent() = default;

 private:
  enum class Kind { printing, paused, resuming, stopped, aborted };

  Intent(Kind kind, std::string reason, PausedBy by) : kind_(kind), by_(by), reason_(std::move(reason)) {}

  Kind kind_ = Kind::printing;
  PausedBy by_ = PausedBy::session;
  std::string reason_;
};

}  // namespace unicursal::host
