// Hands lines to the link and keeps count of them, so that the journal always says which line of the print
// the printer is at, however this program ends. Places, legs and anchors: host/spool/journal.hpp.
//
// Lines of the session's own that come between two lines of the print (a pause, a change of temperature) are
// *interposed*: places do not count them, so the journal gets a new anchor for the line that follows them.
//
// It belongs to the loop's thread. Precondition of everything that sends: the link is connected.
#pragma once

#include <asio/awaitable.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/link/link.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

class PlaceKeeper {
 public:
  /// `spool`: nullptr for a print that is not kept. Both must outlive this object.
  PlaceKeeper(Link& link, Spool* spool);
  PlaceKeeper(const PlaceKeeper&) = delete;
  PlaceKeeper& operator=(const PlaceKeeper&) = delete;

  /// The session goes on in the journal's last leg: the printer's next line has the number and the place of
  /// `next`. Call it before any line is sent. Precondition: a spool.
  void rejoin(const Anchor& next);

  /// Sends lines of the print; returns when they are written. Throws LinkError.
  asio::awaitable<void> send(std::vector<std::string> lines);
  /// Sends lines of the session's own between two of the print; comments are left out. Throws LinkError.
  asio::awaitable<void> interpose(std::vector<std::string> lines);
  /// Sets a listener for such lines, before they are sent.
  void on_interposed(std::function<void(const std::vector<std::string>&)> listener) {
    on_interposed_ = std::move(listener);
  }
  /// The place at which the session has begun.
  std::uint64_t begin() const { return begin_; }
  /// The place of the print's next line.
  std::uint64_t next() const { return next_; }
  /// The places before this one were acknowledged.
  std::uint64_t acknowledged() const;

  /// Writes down how far the print has come.
  void record_progress();
  /// Writes down lines that will lead the nozzle away from the part, and perhaps back; empty: it is back.
  void record_way(const std::vector<std::string>& lines);
  /// Writes down that the printer has run them.
  void record_aside();
  /// From now on lines belong to the end of the print, not to its spool.
  void leave_print(const std::vector<std::string>& end);
  /// Whether leave_print() was called.
  bool has_left_print() const { return left_; }
  void record_end(const Ended& ended);

 private:
  void take_numbering(std::uint32_t number, std::uint64_t line);

  Link& link_;
  Spool* const spool_;
  std::uint64_t begin_ = 0;       ///< place in the leg at which this session begins
  std::uint64_t next_ = 0;        ///< places before it were handed to the link
  std::uint64_t interposed_ = 0;  ///< lines handed to the link that have no place
  bool interposing_ = false;      ///< such lines are on their way
  bool first_numbering_ = true;   ///< no number of this session is known yet
  Anchor numbering_;              ///< of a line; `place` counts all lines of this session
  bool left_ = false;
  std::function<void(const std::vector<std::string>&)> on_interposed_;
};

}  // namespace unicursal::host
