// The history of a print: which lines were passed to the link, which of them the printer has accepted, their
// line numbers, and how the print ended. It is written during the print, off the event loop, and read when
// the print is resumed.
//
// A print's lines are counted from 0. They are sent in *legs*: the first leg begins at line 0. After the
// printer was lost, a new leg begins with a few lines of its own (the *lead-in*), which bring the printer
// back, and continues with the line at which the printer was lost. A *place* is the index of a line in a leg,
// lead-in included. An *anchor* ties a place to the line number on the wire; the lines after it count on from
// there.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/spool/record_file.hpp"

namespace unicursal::host {

struct Leg {
  std::vector<std::string> lead_in;  ///< Lines before the print's own lines.
  std::uint64_t begins_at = 0;       ///< The print's line after the lead-in.
  double height = 0;                 ///< Height of the nozzle before the lead-in, mm.

  /// The print's line at a place; for a place in the lead-in, the line after the lead-in.
  std::uint64_t line(std::uint64_t place) const {
    return place < lead_in.size() ? begins_at : begins_at + (place - lead_in.size());
  }
};

struct Anchor {
  std::uint32_t number = 0;
  std::uint64_t place = 0;
};

enum class LegOutcome : std::uint8_t { completed, stopped, failed };

struct Ended {
  LegOutcome outcome = LegOutcome::failed;
  std::string reason;  ///< A sentence, or empty.
};

/// A leg behind which another one has begun, since the printer had lost its place.
struct GivenUpLeg {
  Leg leg;
  std::uint64_t acknowledged = 0;  ///< Places before this one were acknowledged.
};

/// The contents of a journal.
struct JournalState {
  std::uint64_t legs = 0;            ///< Number of legs that have begun.
  Leg leg;                           ///< The last leg.
  std::vector<GivenUpLeg> given_up;  ///< The legs before it.
  std::vector<Anchor> anchors;       ///< Anchors since the line numbers were last reset.
  std::uint64_t handed = 0;          ///< Places before this one were passed to the link.
  std::uint64_t acknowledged = 0;    ///< Places before this one were acknowledged.
  /// Lines sent after `handed` that parked the nozzle, and perhaps returned.
  std::vector<std::string> parking;
  bool aside = false;          ///< Whether those lines, and everything before them, were executed.
  bool superseded = false;     ///< Whether another print has begun, so that the printer has moved.
  std::string superseded_by;   ///< That print; may be empty.
  bool connected = false;      ///< Whether any leg had an anchor, so that something may have been sent.
  std::uint64_t furthest = 0;  ///< The print's lines before this one were passed to the link in some leg.
  std::optional<Ended> ended;

  /// The place of the line that a firmware asks for by `number`, perhaps modulo 65536; nullopt if it cannot
  /// be a line of this leg.
  std::optional<std::uint64_t> place_of(std::uint32_t number) const;
};

/// Reads a journal up to its torn end. Throws SpoolError if it cannot be read at all, is of another version,
/// or is damaged before its end. If `sound` is given, it receives the number of bytes that a writer may keep.
JournalState read_journal(const std::filesystem::path& file, std::uint64_t* sound = nullptr);

class Journal {
 public:
  /// Continues the file after its first `sound` bytes. Throws SpoolError.
  Journal(const std::filesystem::path& file, std::uint64_t sound);
  /// Writes what still waits.
  ~Journal();

  // These write at once, so that the event is on record however this program ends. They do not wait for the
  // disk.
  void begin_session();  ///< The program begins or resumes the print; an earlier end no longer counts.
  void begin_leg(const Leg& leg);
  /// From now on the line number `anchor.number` on the wire is the line at `anchor.place`. `restarts` means
  /// that earlier anchors are invalid.
  void anchor(const Anchor& anchor, bool restarts);
  void park(const std::vector<std::string>& lines);  ///< Lines that are sent instead of the rest, or first.
  void aside();                                      ///< The lines of park() were executed.
  void end(const Ended& ended);
  void supersede(const std::string& by);

  /// Written by a thread of its own; only the latest progress counts.
  void progress(std::uint64_t handed, std::uint64_t acknowledged);

  /// Brings everything to the disk, the latest progress included. Throws SpoolFull.
  void sync();

  /// Why something could not be written; nullopt if everything was.
  std::optional<std::string> problem() const;

 private:
  struct Progress {
    std::uint64_t handed, acknowledged;
  };

  void write_now(const std::string& content);
  // To be called with the mutex locked:
  bool append(const std::string& content);
  void write_latest();
  void work(std::stop_token stop);

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  RecordWriter writer_;
  std::optional<Progress> latest_;
  std::optional<Progress> unwritten_;  ///< there was no room for it
  bool unsynced_ = false;
  std::optional<std::string> problem_;
  std::jthread thread_;  ///< The last member, so that it ends before the members that it uses.
};

}  // namespace unicursal::host
