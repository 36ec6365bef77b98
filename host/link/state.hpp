// The inside of a link: one conversation with one firmware.
//
// What is known of firmwares (Marlin 2.1, Repetier 1.0; observed), and what follows:
// - A damaged line is answered by "Error:… Last Line: 3", "Resend: 4", "ok"; that ok belongs to the error.
//   The receive buffer is flushed, so lines behind it vanish or raise their own errors. Hence one resend at a
//   time: nothing is sent and no ok counts until the line has been quiet for a while; then everything from
//   the number last asked for goes out again.
// - A repeated line is dropped silently, without an ok, and oks may be lost or damaged. Hence oks only move
//   the window, and numbers decide what the printer has.
// - A line with a number that cannot be right makes the firmware tell its last one, at once and without
//   effect. After silence, this probe finds out where the printer is; a M105 behind it (whose answer looks
//   unlike any other ok) then proves that all before it has been executed.
// - After anything odd the end of a job is in doubt: the last line may have got the ok of another. drain()
//   therefore ends with a probe if there was any oddity since the last one.
// - Damage that makes a numbered line look like an unnumbered command gets "Unknown command" and an ok; the
//   gap shows with the next number. Damage that the 8-bit checksum does not see cannot be found by anyone.
// - "start" in mid-print means that the printer has forgotten everything: nothing may be sent any more.
// - Lines stay within 95 characters up to number 99 999 999, which at 600 lines/s is reached after two days
//   without pause. Then, when all is acknowledged, M110 goes out alone and they are counted from 1 again.
// - "ok N7 P3 B1" (ADVANCED_OK) tells how many commands wait in the queue behind line 7: those have left the
//   receive buffer, so that others may follow. What was sent out of band would be counted with them: then it
//   is not used any more.
// - A Marlin with Cap:BUSY_PROTOCOL is never silent for more than 2 s while it works, a Repetier says "wait"
//   when it does not: both tell soon that an ok was lost, long before the deadline for printers that do not.
// - Temperatures: M155 where the firmware knows it, since a M105 waits behind every move; otherwise a
//   numbered M105, which shifts the numbers of the lines behind it.
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "firmware_gcode/reply/reply.hpp"
#include "host/link/ledger.hpp"
#include "host/link/line_splitter.hpp"
#include "host/link/link.hpp"
#include "host/loop/signal.hpp"

namespace unicursal::host {

struct Link::State : std::enable_shared_from_this<Link::State> {
  enum class Phase { greeting, streaming };

  State(asio::any_io_executor on, int descriptor, LinkOptions with);

  // Bytes (wire.cpp)
  /// Reads until the port ends; `self` keeps the state alive meanwhile, here and in supervise().
  asio::awaitable<void> listen(std::shared_ptr<State> self);
  void write(std::string_view text);
  void pump();  ///< writes what may be written now
  void wait_for_port();
  void cool_down() noexcept;
  void end_wait_for_user() noexcept;
  void emergency_stop() noexcept;
  void close();

  // What replies mean (replies.cpp)
  void hear(std::string_view line);
  void take(const gcode::reply::Ok& ok);
  void take(const gcode::reply::Resend& resend);
  void take(const gcode::reply::Error& error);
  void take(const gcode::reply::Start& start);
  void take(const gcode::reply::Busy& busy);
  void take(const gcode::reply::TemperatureReport& report);
  void take(const gcode::reply::Wait& wait);
  void take(const gcode::reply::Firmware& firmware);
  void take(const gcode::reply::Capability& capability);
  void take(const gcode::reply::Echo& echo);
  void take(const gcode::reply::Position& position);
  void take(const gcode::reply::Unknown& unknown);
  template <class Other>
  void take(const Other&) {}
  void asked_for(std::uint32_t number);
  void note(const gcode::Temperatures& told);
  /// How many lines behind the acknowledged one wait in the firmware's command queue.
  std::uint32_t note_places(const gcode::reply::Ok& ok);

  // Conversation (conversation.cpp)
  asio::awaitable<void> greet();
  asio::awaitable<Rejoined> find_again(std::uint32_t beyond);
  asio::awaitable<std::uint32_t> ask_for_number(std::uint32_t beyond);
  asio::awaitable<void> ask(std::string_view query, const std::function<bool()>& answered);
  void go_on(std::uint32_t next);
  asio::awaitable<void> supervise(std::shared_ptr<State> self);
  asio::awaitable<void> ask_firmware();
  asio::awaitable<void> reset_numbers();
  asio::awaitable<void> begin_reports();
  asio::awaitable<void> count_anew();
  void ask_temperatures();
  void insert_query();
  asio::awaitable<void> answer_resend();
  asio::awaitable<void> resynchronise();
  asio::awaitable<bool> probe();
  void resume_from(std::uint32_t number, bool with_fence);
  /// Until no byte has come for `pause`, or for about a second at most.
  asio::awaitable<void> quiet(Duration pause);
  /// Nothing has failed, and all is in the printer's hands; without a word for this long that is in doubt.
  Duration patience() const;
  TimePoint stall_deadline() const;
  TimePoint ok_deadline() const;  ///< by when an ok must have come, however busy the printer is
  TimePoint now() const { return options.clock->now(); }
  bool settled() const { return ledger.settled() && !doubt && !holding; }

  /// Waits without a deadline of its own; throws LinkError when the link fails meanwhile.
  asio::awaitable<void> until(const std::function<bool()>& ready);
  /// Returns whether `ready` came true by the deadline; throws LinkError when the link fails meanwhile.
  asio::awaitable<bool> until(const std::function<bool()>& ready, TimePoint deadline);
  /// The end: everyone who waits gets a LinkError with this message. The first failure counts.
  void fail(const std::string& message);
  /// Fails and throws the LinkError. In mid-print the heaters are switched off first, if it still listens.
  [[noreturn]] void give_up(std::string message);
  std::string with_heat_warning(const std::string& message) const;

  asio::any_io_executor executor;
  asio::posix::stream_descriptor port;
  const LinkOptions options;
  LinkStatistics statistics;
  std::string firmware;
  gcode::Identity identity;
  gcode::Temperatures temperatures;
  std::optional<PrinterQueues> queues;
  TimePoint ask_at = TimePoint::max();  ///< for temperatures, of firmwares that make no reports
  std::function<void(const std::string&)> listener;
  std::function<void(std::uint32_t, std::uint64_t)> numbering;
  std::optional<std::string> failure;
  Signal signal;

  Ledger ledger;
  LineSplitter splitter;
  std::string unsent;             ///< bytes that the port has not taken yet
  bool waiting_for_port = false;  ///< until it takes them

  Phase phase = Phase::greeting;
  // While greeting:
  bool restarted = false;                  ///< it has said that it starts
  std::optional<std::uint32_t> told_next;  ///< number of the line that it wants
  std::optional<std::array<double, 3>> told_position;
  std::optional<gcode::Temperatures> told_temperatures;

  int interruptions = 0;                  ///< waits for heat that are still to be ended
  bool draining = false;                  ///< someone waits in drain()
  bool holding = false;                   ///< nothing may be sent and no ok counts: resend or probe under way
  bool probing = false;                   ///< the next error is our own doing
  bool doubt = false;                     ///< something odd has happened since the last proof
  bool out_of_band = false;               ///< lines without a number are perhaps in the printer's queue
  int idle_words = 0;                     ///< times it has said that it waits while lines were in flight
  std::optional<std::uint32_t> asked;     ///< the line that the printer wants
  std::optional<std::uint32_t> stranger;  ///< one that it asked for and cannot be given
  int fruitless_resends = 0;              ///< since more lines were acknowledged than ever before
  std::uint64_t best_acknowledged = 0;
  std::string last_error;

  std::uint64_t bytes_heard = 0;
  std::uint64_t oks = 0, refusals = 0, lines_heard = 0, waits_heard = 0;
  bool waits_for_user = false;  ///< as the printer has last said
  TimePoint last_ok = now();
  TimePoint last_life = now();  ///< of an ok or a busy
};

}  // namespace unicursal::host
