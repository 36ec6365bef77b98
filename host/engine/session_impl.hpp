// The inside of a session: one coroutine goes through the print, commands leave marks that it finds between
// two batches of lines. Lines of the session's own that come in between (a pause, a change of temperature)
// are *interposed*: the spool's places do not count them, so the journal gets a new anchor behind them.
#pragma once

#include <asio/thread_pool.hpp>
#include <deque>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/interruption/modal_state.hpp"
#include "firmware_gcode/interruption/pause.hpp"
#include "host/engine/session.hpp"
#include "host/loop/sentence.hpp"
#include "host/loop/signal.hpp"

namespace unicursal::host {

/// What the print cannot go on without, and may have to wait for.
struct Need {
  std::string why;                              ///< of the waiting, a sentence
  std::function<bool()> come;                   ///< whether it is there
  std::function<asio::awaitable<void>()> look;  ///< now and then, where nobody tells that it has come
  TimePoint at = TimePoint::max();              ///< when it will be there, in virtual time
  bool at_work = false;                         ///< this computer is busy with it: virtual time stands still
};

struct Session::State {
  State(asio::any_io_executor on, int descriptor, Source& of, StreamSettings with);
  ~State();

  // The way through a print (session.cpp)
  asio::awaitable<void> print();
  asio::awaitable<void> begin();
  asio::awaitable<void> rejoin();
  void check_firmware();
  asio::awaitable<void> check_mixing();
  asio::awaitable<void> send_spooled();
  void begin_to_catch_up();
  asio::awaitable<void> catch_up();
  asio::awaitable<void> start();
  asio::awaitable<void> get_hot();
  asio::awaitable<void> send_pieces();
  void time_layers(const gcode::Chunk& chunk);
  asio::awaitable<std::optional<PrintStep>> next_piece();
  asio::awaitable<void> until_ready();
  asio::awaitable<void> until(TimePoint ready);
  void tell_position();
  asio::awaitable<void> finish();
  asio::awaitable<void> park();
  asio::awaitable<void> send_last(gcode::Chunk chunk);
  asio::awaitable<void> send(const gcode::Chunk& chunk);
  asio::awaitable<void> hand(std::vector<std::string> lines);
  StreamResult result(const std::exception_ptr& error);

  // What comes in between (session_control.cpp)
  /// Everything that was asked for since the last batch; a pause is over when this returns.
  asio::awaitable<void> between();
  asio::awaitable<void> hold();
  asio::awaitable<void> wait_held();
  asio::awaitable<void> go_aside(std::string why, bool moving);
  asio::awaitable<void> come_back(bool moving);
  asio::awaitable<void> heat_again();
  asio::awaitable<void> stay_aside(bool moved);
  /// Returns when it has come or the print is to end. The nozzle is not left on the part for long.
  asio::awaitable<void> wait_for(const Need& need);
  asio::awaitable<void> wait_aside(const Need& need);
  void go_on();
  asio::awaitable<void> interpose(std::vector<std::string> lines);
  asio::awaitable<void> confirm_stop();
  gcode::Pause pause_here() const;
  bool placed() const;
  /// Whether the nozzle stands where plastic was laid.
  bool laying() const { return layers_before > 0 || seconds_sent > 0; }
  bool held() const { return state == SessionState::pausing || state == SessionState::paused; }
  bool ending() const { return state == SessionState::finishing || state == SessionState::cancelling; }
  bool to_be_interrupted() const { return stopped || aborted; }
  void stop(const std::string& reason);
  void obey(const std::string& action);
  void hold_because_cold();
  asio::awaitable<void> make_changes();
  Refusal change(const std::string& line);

  // The spool (session_journal.cpp)
  void keep_journal();
  void note_progress();
  void end_journal(const StreamResult& ended);
  asio::awaitable<bool> keep(SpooledChunk record, gcode::Chunk& chunk);
  asio::awaitable<std::string> try_to_keep(SpooledChunk& record, gcode::Chunk& chunk);
  asio::awaitable<std::string> write(const SpooledChunk& record);

  // What is told (session_status.cpp)
  void hear(const std::string& line);
  void enter(SessionState next, const std::string& reason = {});
  void tell(SessionEvent::Kind kind, const std::string& text = {}) const;
  void warn(const std::string& sentence);
  SessionStatus status() const;
  double seconds_left() const;
  std::string mixture() const;

  asio::thread_pool disk{1};
  const asio::any_io_executor executor;
  const int port;
  Source& source;
  const StreamSettings settings;
  Spool* const spool;
  const std::shared_ptr<Clock> clock;
  const TimePoint began = clock->now();
  Signal wake;
  const std::shared_ptr<State*> self;  ///< for those who may come when it is gone
  Link link;
  std::function<void(const SessionEvent&)> observer;

  SessionState state = SessionState::connecting;
  std::string reason;
  std::vector<std::string> warnings;

  // Asked for
  std::optional<std::string> pause_wanted;  ///< why
  bool resume_wanted = false;
  TimePoint hot_until = TimePoint::max();  ///< while it stands aside
  bool lacking = false;         ///< it stands aside because it lacks something, not because it was asked to
  bool firmware_holds = false;  ///< it has paused on its own: it parks and returns by itself
  bool stopped = false;
  std::string stop_reason;
  bool aborted = false;
  std::deque<std::string> wanted;  ///< lines to be interposed

  // Found out
  bool heating = false;   ///< the printer may be in a wait for heat
  bool homeless = false;  ///< it does not know where its nozzle is: it must not move
  bool caught_up = true;  ///< the source belongs to this thread
  std::exception_ptr catching_up_failed;
  bool parking = false;  ///< what is sent is not of the spool
  bool parked = false;
  std::vector<std::string> way_aside;  ///< the lines that have led the nozzle away, in a pause
  bool cooled = false;                 ///< the nozzle, while it is held
  bool unfit = false;                  ///< the printer is another one than the print was made for
  bool print_begun = false;            ///< lines of it may have been sent
  bool mixes = true;                   ///< as far as the printer has told
  bool halted = false;                 ///< the firmware has said that it has stopped itself
  std::optional<Lost> lost;
  double waited = 0;  ///< s for pieces
  std::size_t pauses = 0;
  gcode::Temperatures temperatures;
  double speed_percent = 100, flow_percent = 100;

  // Where it is
  gcode::ModalState modal;  ///< after all lines handed to the link
  std::uint64_t first = 0;  ///< place in the leg at which this session begins
  std::uint64_t place = 0;  ///< before which everything was handed to the link
  std::uint64_t extra = 0;  ///< lines handed that are none of the leg's
  bool interposing = false;
  bool anew = true;               ///< the next numbering is the first
  Anchor numbered;                ///< `place` counts all lines of this session
  std::size_t layers_before = 0;  ///< that the spool held when this session began
  std::size_t layers_begun = 0;
  bool replaying = false;           ///< what is sent comes from the spool
  mutable double told_percent = 0;  ///< it never falls, though a layer may take longer than was foretold
  double layer_fraction = 0;        ///< of the chunk that is being sent
  double seconds_sent = 0, chunk_seconds = 0;  ///< of the chunks before, of the one that is being sent
  double unfinished_seconds = 0;               ///< of these, a layer's that ends in a later chunk
  double later_seconds = 0;                    ///< and those of whole layers, but for the print's first
  std::size_t layers_sent = 0;                 ///< whose seconds are in `seconds_sent`
  std::size_t whole = 0;                       ///< layers that end in the chunk that is being sent
};

constexpr double no_time = 0;
constexpr auto pause_when_hot = "it is held as soon as it is hot";

}  // namespace unicursal::host
