// What has happened to a print: which of its lines were handed to the printer and which it has taken, under
// which numbers, and how it ended. Written while printing, off the event loop; read after everything else is
// gone.
//
// A print's lines are counted from 0. It goes through them in *legs*: the first begins at line 0; after the
// printer was lost, another begins with a few lines of its own (lead-in) that bring the printer back, and
// goes on with the line where that was. A *place* counts lines from the beginning of a leg, its lead-in
// included. An *anchor* ties a place to the number that its line has on the wire; later lines count on from
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
  std::vector<std::string> lead_in;  ///< before the print's own lines
  std::uint64_t begins_at = 0;       ///< the print's line after the lead-in
  double height = 0;                 ///< mm, where the nozzle was before the lead-in

  /// The print's line at a place; the one after the lead-in for places within that.
  std::uint64_t line(std::uint64_t place) const {
    return place < lead_in.size() ? begins_at : begins_at + (place - lead_in.size());
  }
};

struct Anchor {
  std::uint32_t number = 0;
  std::uint64_t place = 0;
};

enum class Outcome : std::uint8_t { completed, stopped, failed };

struct Ended {
  Outcome outcome = Outcome::failed;
  std::string reason;  ///< a sentence, or empty
};

/// What a journal tells.
struct JournalState {
  std::uint64_t legs = 0;            ///< begun
  Leg leg;                           ///< the last one
  std::vector<Anchor> anchors;       ///< since the numbers began anew
  std::uint64_t handed = 0;          ///< places before this one were handed to the link
  std::uint64_t acknowledged = 0;    ///< places before this one have their ok
  std::vector<std::string> parking;  ///< lines that led the nozzle away, after `handed`, and perhaps back
  bool aside = false;                ///< it has come where these led it, and everything before them was run
  bool superseded = false;           ///< another print has begun: the printer is no longer where it was
  std::optional<Ended> ended;

  /// The place of the line that a firmware asks for by `number`, perhaps modulo 65536; none if no line of
  /// this leg can have been meant.
  std::optional<std::uint64_t> place_of(std::uint32_t number) const;
};

/// Reads as much as is sound. Throws SpoolError when it cannot be read at all or is of another version.
/// `sound`, if given, gets the bytes that a writer may keep.
JournalState read_journal(const std::filesystem::path& file, std::uint64_t* sound = nullptr);

class Journal {
 public:
  /// Goes on behind the first `sound` bytes. Throws SpoolError.
  Journal(const std::filesystem::path& file, std::uint64_t sound);
  /// Writes what still waits.
  ~Journal();

  // At once, so that it is known however this program ends. No longer than a write to memory takes.
  void begin_session();  ///< this program begins or goes on; an end told earlier was none
  void begin_leg(const Leg& leg);
  /// From now on line `number` on the wire is the one at `place`. `anew`: numbers told before mean nothing.
  void anchor(const Anchor& anchor, bool anew);
  void park(const std::vector<std::string>& lines);  ///< these are sent instead of the rest, or before it
  void aside();                                      ///< and were run
  void end(const Ended& ended);
  void supersede();

  /// By a thread of its own: the latest is what counts.
  void progress(std::uint64_t handed, std::uint64_t acknowledged);

  /// Why something could not be written, if so.
  std::optional<std::string> problem() const;

 private:
  struct Progress {
    std::uint64_t handed, acknowledged;
  };

  void write_now(const std::string& content);
  // Locked:
  void append(const std::string& content);
  void write_latest();
  void work(std::stop_token stop);

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  RecordWriter writer_;
  std::optional<Progress> latest_;
  bool unsynced_ = false;
  std::optional<std::string> problem_;
  std::jthread thread_;  ///< last, so that it ends before what it uses
};

}  // namespace unicursal::host
