// The inside of a session: one coroutine runs the print. Commands leave marks, which it reads between two
// batches of lines. Each part has one duty:
//
//   Link         the conversation with the firmware (host/link)
//   Intent       whether the print goes on, is held, or ends
//   Progress     layers, seconds and per cent
//   PrinterView  what is known about the printer
//   HeatWatch    whether nozzle and bed keep their heat
//   HeatForecast how long they will still heat
//   PlaceKeeper  hands lines to the link, and keeps the journal
//   Holding      pauses, waits and changes
//   Announcer    state, warnings and events
//
// Everything belongs to the loop's thread, except for the work on `disk`.
#pragma once

#include <asio/thread_pool.hpp>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/announcer.hpp"
#include "host/engine/heat_forecast.hpp"
#include "host/engine/heat_watch.hpp"
#include "host/engine/holding.hpp"
#include "host/engine/intent.hpp"
#include "host/engine/line_follower.hpp"
#include "host/engine/place_keeper.hpp"
#include "host/engine/printer_view.hpp"
#include "host/engine/progress.hpp"
#include "host/engine/session.hpp"
#include "host/loop/sentence.hpp"
#include "host/loop/signal.hpp"

namespace unicursal::host {

struct Session::State {
  State(asio::any_io_executor on, int descriptor, Source& of, StreamSettings with);
  ~State();

  // The way through a print (session_impl.cpp)
  asio::awaitable<void> print();
  asio::awaitable<void> begin();
  asio::awaitable<void> rejoin();
  void check_firmware();
  asio::awaitable<void> ask(std::vector<std::string> questions);
  asio::awaitable<void> check_abilities();
  const std::vector<std::string>& first_lines();
  const Leg& leg() const;
  asio::awaitable<void> send_spooled();
  void begin_to_catch_up();
  asio::awaitable<void> catch_up();
  asio::awaitable<void> start();
  asio::awaitable<void> get_hot();
  asio::awaitable<void> send_steps();
  asio::awaitable<std::optional<PrintStep>> next_step();
  asio::awaitable<void> wait_until_planned();
  asio::awaitable<void> wait_until(TimePoint ready);
  asio::awaitable<void> finish();
  asio::awaitable<void> park();
  asio::awaitable<void> see_it_cool();
  asio::awaitable<void> hand_back();
  [[noreturn]] void refuse(const std::string& why);
  asio::awaitable<void> send_end(gcode::Chunk chunk);
  asio::awaitable<void> send(const gcode::Chunk& chunk);
  asio::awaitable<void> send_batch(std::vector<std::string> lines);
  void report_position();
  StreamResult conclude(const std::exception_ptr& error);

  // Chunks on disk (session_spool.cpp)
  asio::awaitable<bool> spool_chunk(SpooledChunk record, gcode::Chunk& chunk);
  asio::awaitable<std::string> try_to_spool(SpooledChunk& record, gcode::Chunk& chunk);
  asio::awaitable<std::string> write(const SpooledChunk& record);

  // The printer's own display (session_display.cpp)
  asio::awaitable<void> show_progress();
  asio::awaitable<void> show_end();

  // What comes from outside (session_commands.cpp)
  void hear(const std::string& line);
  void watch_heat();
  void obey(const std::string& action);
  void stop(const std::string& reason);
  /// A heater that is waited for gives no heat: the same, but the print has failed.
  void give_up_heating(const std::string& reason);
  void stop_at_once();
  asio::awaitable<void> confirm_stop();
  Refusal too_much(double speed, double flow) const;

  // What is reported (session_status.cpp)
  SessionStatus status() const;
  LinePlace line_place() const;
  Ahead ahead() const;
  std::optional<double> left() const;

  asio::thread_pool disk{1};
  const asio::any_io_executor executor;
  const int port;
  Source& source;
  const StreamSettings settings;
  Spool* const spool;  ///< nullptr for a print that is not kept
  const std::shared_ptr<Clock> clock;
  const TimePoint began = clock->now();
  Signal wake;
  const std::shared_ptr<State*> alive;  ///< for callbacks that may come when this object is gone
  Link link;

  Announcer announcer;
  Intent intent;
  Progress progress;
  PrinterView printer;
  HeatWatch heat_watch;
  WarmUpWatch warm_up_watch;
  HeatForecast heat_forecast;
  PlaceKeeper places;
  Holding holding;

  std::optional<gcode::Chunk> first;  ///< the source's start, until it is sent
  bool caught_up = true;              ///< false while the source belongs to the thread of `disk`
  std::exception_ptr catching_up_failed;
  StreamResult result;          ///< as far as it is known
  std::string gave_up_heating;  ///< why; empty if it did not
};

}  // namespace unicursal::host
