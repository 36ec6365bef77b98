// The internal state of a link: one conversation with one firmware.
//
// How firmwares behave (Marlin 2.1 and Repetier 1.0, observed; sim/README.md), and what follows for the link:
// - A damaged line is answered with "Error:… Last Line: 3", "Resend: 4", "ok"; that ok belongs to the error.
//   The receive buffer is flushed, so later lines vanish or raise their own errors. The link therefore
//   handles one resend at a time: it sends nothing and counts no ok until the line has been quiet for a
//   while; then it sends everything again, from the number that was last asked for.
// - A repeated line is dropped silently, without an ok, and oks may be lost or damaged. Therefore oks only
//   move the window, and numbers decide what the printer has received.
// - A line with an impossible number makes the firmware report its last number at once, without any effect.
//   After silence, this probe finds out how far the printer is. An M105 after it, whose answer differs from
//   every other ok, proves that everything before has been executed.
// - After any irregularity the end of a job is in doubt: the last line may have got the ok of another one.
//   drain() therefore ends with a probe if there was an irregularity since the last probe.
// - A numbered line that damage turns into an unnumbered command gets "Unknown command" and an ok; the next
//   number reveals the gap. Damage with a matching 8-bit checksum cannot be detected.
// - "start" in mid-print means that the printer has lost its state: nothing more may be sent.
// - Lines stay within 95 characters up to number 99 999 999, which takes two days at 600 lines/s. Then, when
//   everything is acknowledged, M110 is sent alone and lines are counted from 1 again.
// - "ok N7 P3 B1" (ADVANCED_OK) reveals how many commands wait in the queue after line 7. They have left the
//   receive buffer, so others may follow. Lines that were sent out of band would be counted with them; from
//   then on the link does not use this.
// - A Marlin that reports that it is busy is never silent for more than 2 s while it works, and an idle
//   Repetier says "wait": both reveal a lost ok long before the deadline for other printers. A stock Marlin
//   does not list Cap:BUSY_PROTOCOL; the link learns it from the first such report, which homing brings.
// - A Marlin without that capability may be silent for as long as a move takes. The link knows how long the
//   moves take that it has sent (host/link/move_clock.hpp), and probes soon after they must have ended.
// - During a slow command (heating, probing the bed) a printer may be silent for minutes, or say only things
//   like "Bed X: 10 Y: 10 Z: 0.1". It reads nothing meanwhile. The link probes, too, since the ok may be
//   lost, but goes on waiting: the answer comes when the command is done.
// - RepRapFirmware drops a damaged line without a word, executes numbered lines in any order, and takes lines
//   without a checksum. One line at a time is therefore in flight. If its ok does not come, M114 shows
//   whether it was executed (host/link/whereabouts.hpp); if it does not show that, the print ends. From the
//   first M105 on it reports temperatures every 2 s while a command runs, which is its sign of life.
// - Temperatures: the link uses M155 if the firmware has it, since M105 waits behind every move; otherwise a
//   numbered M105, which shifts the numbers of the lines after it.
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "firmware_gcode/reply/identity.hpp"
#include "firmware_gcode/reply/reply.hpp"
#include "host/link/host_prompt.hpp"
#include "host/link/ledger.hpp"
#include "host/link/line_splitter.hpp"
#include "host/link/link_types.hpp"
#include "host/link/whereabouts.hpp"
#include "host/loop/signal.hpp"

namespace unicursal::host {

struct LinkState : std::enable_shared_from_this<LinkState> {
  enum class Phase { greeting, streaming };

  LinkState(asio::any_io_executor on, int descriptor, LinkOptions with);

  // Bytes (wire.cpp)
  /// Reads until the port ends. `self` keeps the state alive meanwhile, here and in supervise().
  asio::awaitable<void> listen(std::shared_ptr<LinkState> self);
  void write(std::string_view text);
  void pump();  ///< Writes everything that may be written now.
  void wait_for_port();
  void cool_down() noexcept;
  void end_wait_for_user() noexcept;
  void answer_prompt(std::size_t button) noexcept;
  void write_past_queue(const std::string& line);
  void emergency_stop() noexcept;
  void close();

  // Replies (replies.cpp)
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
  void take(const gcode::reply::Action& action) { prompt.take(action.text); }
  void take(const gcode::reply::Position& position);
  void take(const gcode::reply::Unknown& unknown);
  template <class Other>
  void take(const Other&) {}
  void asked_for(std::uint32_t number);
  void note(const gcode::Temperatures& reported);
  /// Notes the queues; returns the number of lines after the acknowledged one in the firmware's command
  /// queue.
  std::uint32_t note_places(const gcode::reply::Ok& ok);

  // Conversation (conversation.cpp)
  asio::awaitable<void> greet();
  asio::awaitable<Rejoined> find_again(std::uint32_t beyond);
  asio::awaitable<std::uint32_t> ask_for_number(std::uint32_t beyond);
  asio::awaitable<void> ask(std::string_view query, const std::function<bool()>& answered);
  void go_on(std::uint32_t next);
  asio::awaitable<void> supervise(std::shared_ptr<LinkState> self);
  asio::awaitable<void> limit_wait(std::shared_ptr<LinkState> self, std::uint32_t beyond);
  asio::awaitable<void> ask_firmware();
  asio::awaitable<void> reset_numbers();
  asio::awaitable<void> begin_reports();
  asio::awaitable<void> count_again();
  void ask_temperatures();
  void insert_query();
  asio::awaitable<void> answer_resend();
  asio::awaitable<void> resynchronise();
  asio::awaitable<bool> probe(Duration patience);
  /// Whether a slow command may still explain that the printer does not answer.
  bool still_at_work() const;
  void note_loss();
  void resume_from(std::uint32_t number, bool with_fence);
  /// Waits until no byte has arrived for `pause`, but at most about a second longer.
  asio::awaitable<void> quiet(Duration pause);
  /// Longest silence of a working printer; after it, the link probes.
  Duration patience() const;
  TimePoint stall_deadline() const;
  /// Time by which a printer whose moves are all known must have answered.
  TimePoint answer_deadline() const;
  TimePoint ok_deadline() const;  ///< Time by which an ok must have arrived, however busy the printer is.
  TimePoint now() const { return options.clock->now(); }
  bool settled() const { return ledger.settled() && !doubt && !holding; }

  // One line at a time (one_by_one.cpp)
  bool one_by_one() const;
  Ledger new_ledger(std::uint32_t first) const;
  asio::awaitable<void> begin_one_by_one();
  asio::awaitable<void> find_out();
  void judge_line_in_flight(bool late_ok);

  /// Waits until `ready`, without a deadline; throws LinkError if the link fails meanwhile.
  asio::awaitable<void> until(const std::function<bool()>& ready);
  /// Returns whether `ready` came true by the deadline; throws LinkError if the link fails meanwhile.
  asio::awaitable<bool> until(const std::function<bool()>& ready, TimePoint deadline);
  /// Ends the link: every waiter gets a LinkError with this message. The first failure counts.
  void fail(const std::string& message);
  /// Fails and throws the LinkError. In mid-print it first tries to switch the heaters off.
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
  TimePoint ask_at = TimePoint::max();  ///< Next question for temperatures, if the firmware makes no reports.
  std::function<void(const std::string&)> listener;
  std::function<void(std::uint32_t, std::uint64_t)> numbering;
  std::optional<std::string> failure;
  Signal signal;

  Ledger ledger;
  Whereabouts whereabouts;  ///< only kept when lines go one by one
  LineSplitter splitter;
  std::string unsent;             ///< Bytes that the port has not taken yet.
  bool waiting_for_port = false;  ///< Whether the link waits for the port to take them.

  Phase phase = Phase::greeting;
  // While greeting:
  bool restarted = false;                      ///< Whether the printer has said "start".
  std::optional<std::uint32_t> reported_next;  ///< Number of the line that it expects.
  std::optional<std::array<double, 3>> reported_position;
  std::optional<gcode::Temperatures> reported_temperatures;

  int interruptions = 0;                  ///< Waits for heat that are still to be ended.
  bool draining = false;                  ///< Whether drain() waits.
  bool holding = false;                   ///< Nothing may be sent and no ok counts, during a resend or probe.
  bool probing = false;                   ///< The next error is the answer to a probe.
  bool doubt = false;                     ///< There was an irregularity since the last proof.
  bool out_of_band = false;               ///< Lines without a number may be in the printer's queue.
  int idle_words = 0;                     ///< "wait" messages while lines were in flight.
  std::optional<std::uint32_t> asked;     ///< The line that the printer asks for.
  std::optional<std::uint32_t> stranger;  ///< A line that it asks for and that is no longer kept.
  int fruitless_resends = 0;              ///< Resends since the last progress.
  std::uint64_t best_acknowledged = 0;
  int losses = 0;                  ///< Times that the printer lost lines since `losses_since`.
  std::uint64_t losses_since = 0;  ///< Acknowledged lines at that time.
  std::string last_error;

  std::uint64_t bytes_heard = 0;
  std::uint64_t oks = 0, refusals = 0, lines_heard = 0, waits_heard = 0, places_heard = 0;
  bool about_heat = false;      ///< Whether the line that is being handled reports a temperature.
  bool heard_busy = false;      ///< Whether it has ever reported that it is busy.
  bool cut_wait_short = false;  ///< The printer did not end its heating and was stopped.
  bool waits_for_user = false;  ///< According to the printer's last message.
  HostPrompt prompt;            ///< What it asks a person.
  TimePoint last_ok = now();
  TimePoint last_person = now();  ///< Time at which it last said that it waits for a person.
  TimePoint last_life = now();    ///< Time of the last ok or busy.
  TimePoint moves_until = now();  ///< Estimated end of the moves that were acknowledged.
  TimePoint last_line = now();    ///< Time of the last line of any kind.
};

}  // namespace unicursal::host
