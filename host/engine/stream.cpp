#include "host/engine/stream.hpp"

#include <algorithm>
#include <asio/bind_executor.hpp>
#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <asio/thread_pool.hpp>
#include <asio/use_awaitable.hpp>
#include <csignal>
#include <exception>
#include <new>
#include <utility>

#include "host/engine/rejoining.hpp"
#include "host/engine/slow_computer.hpp"
#include "host/link/signal.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

/// Lines handed to the link at once: few, so that a stop takes effect soon.
constexpr std::size_t batch = 16;

constexpr auto full_disk_pause = std::chrono::seconds(2);  ///< between attempts to write to it

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

bool moves_away(const std::string& line) {
  const bool move = line.starts_with("G0 ") || line.starts_with("G1 ");
  return move && (line.find(" X") != std::string::npos || line.find(" Y") != std::string::npos);
}

std::string sentence(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return "memory ran out; close other programs or choose a coarser job";
  } catch (const std::exception& known) {
    return known.what();
  } catch (...) {
    return "something unknown went wrong";
  }
}

/// Lines of a lead-in up to the last one that waits for heat: what follows moves.
std::uint64_t heat_lines(const std::vector<std::string>& lead_in) {
  const auto waits = [](const std::string& line) {
    return line.starts_with("M109") || line.starts_with("M190");
  };
  const auto last = std::find_if(lead_in.rbegin(), lead_in.rend(), waits);
  return static_cast<std::uint64_t>(lead_in.rend() - last);
}

SpooledChunk spooled(const PlannedLayer& planned, const PreparedJob& prepared) {
  SpooledChunk chunk;
  chunk.kind = SpooledChunk::Kind::layer;
  chunk.layer = placed(prepared, planned);
  for (const core::IslandPlan& plan : planned.plans) chunk.efforts.push_back(plan.effort);
  return chunk;
}

/// A stretch of the print and what planning it has cost, in s of this computer's processors.
struct Piece {
  gcode::Chunk chunk;
  double cpu_seconds = 0;
  SpooledChunk record;  ///< what a spool keeps of it, if there is one; the lines are still missing
};

/// What there is to print, piece by piece. All of it is called on the loop's thread.
class Source {
 public:
  virtual ~Source() = default;
  virtual const gcode::Chunk& start() = 0;
  virtual asio::awaitable<std::optional<Piece>> next() = 0;
  virtual gcode::Chunk finish() = 0;
  /// No further piece is needed.
  virtual void cancel() = 0;
  /// The computer that plans it, `charge` times slower.
  virtual SlowComputer computer(double charge) const = 0;
};

class PlannedSource final : public Source {
 public:
  PlannedSource(Lookahead& lookahead, Run& run, bool spooling)
      : lookahead_(lookahead), run_(run), spooling_(spooling) {}

  const gcode::Chunk& start() override { return run_.start(); }
  asio::awaitable<std::optional<Piece>> next() override {
    std::optional<PlannedLayer> layer = co_await lookahead_.next();
    if (!layer) co_return rest();
    Piece piece;
    piece.cpu_seconds = layer->cpu_seconds;
    if (spooling_) piece.record = spooled(*layer, run_.prepared());
    piece.chunk = run_.layer(std::move(*layer));
    co_return piece;
  }
  gcode::Chunk finish() override { return run_.finish(); }
  void cancel() override {
    ended_ = true;
    lookahead_.cancel();
  }
  SlowComputer computer(double charge) const override {
    return {charge, lookahead_.threads(), lookahead_.ahead()};
  }

 private:
  std::optional<Piece> rest() {
    if (std::exchange(ended_, true)) return std::nullopt;
    Piece piece{run_.rest(), 0, {}};
    piece.record.kind = SpooledChunk::Kind::rest;
    return piece;
  }

  Lookahead& lookahead_;
  Run& run_;
  const bool spooling_;
  bool ended_ = false;  ///< nothing is withheld any more, or wanted
};

class FinishedSource final : public Source {
 public:
  explicit FinishedSource(const FinishedPrint& print) : print_(print) {}

  const gcode::Chunk& start() override { return print_.start; }
  asio::awaitable<std::optional<Piece>> next() override {
    if (taken_ == print_.body.size()) co_return std::nullopt;
    co_return Piece{print_.body[taken_++], 0, {}};
  }
  gcode::Chunk finish() override { return print_.finish; }
  void cancel() override { taken_ = print_.body.size(); }
  SlowComputer computer(double) const override { return {0, 1, 1}; }

 private:
  const FinishedPrint& print_;
  std::size_t taken_ = 0;
};

class Stream {
 public:
  Stream(int port, Source& source, const StreamListeners& listeners, const StreamSettings& settings)
      : source_(source),
        listeners_(listeners),
        spool_(settings.spool),
        continuation_(settings.continuation),
        clock_(settings.clock),
        computer_(source.computer(settings.charge)),
        signals_(loop_, SIGINT, SIGTERM),
        sleep_(loop_.get_executor(), clock_),
        link_(loop_.get_executor(), port, options(settings)) {
    if (!is_ignored(SIGHUP)) signals_.add(SIGHUP);
  }

  StreamResult operator()() {
    std::exception_ptr error;
    link_.on_message(listeners_.message);
    if (spool_) keep_journal();
    await_signal();
    asio::co_spawn(loop_, print(), [&](std::exception_ptr thrown) {
      error = thrown;
      loop_.stop();
    });
    try {
      clock_->run(loop_);
    } catch (...) {
      link_.cool_down();
      error = std::current_exception();
    }
    const StreamResult ended = result(error);
    if (spool_ && !lost_) end_journal(ended);
    return ended;
  }

 private:
  static LinkOptions options(const StreamSettings& settings) {
    LinkOptions options = settings.link;
    options.clock = settings.clock;
    return options;
  }

  StreamResult result(const std::exception_ptr& error) const {
    StreamResult result{Ending::completed, {}, parked_, link_.statistics(), link_.firmware(), waited_, lost_};
    if (stopped_) result.ending = Ending::stopped;
    if (error) result.reason = sentence(error);
    if (aborted_) result.reason = "stopped at once; reset the printer before using it again";
    if (!result.reason.empty()) result.ending = Ending::failed;
    return result;
  }

  void await_signal() {
    signals_.async_wait([this](const asio::error_code& error, int signal) {
      if (error) return;
      if (!stopped_)
        stop();
      else if (signal != SIGHUP)
        return abort();
      await_signal();
    });
  }

  void stop() {
    stopped_ = true;
    sleep_.notify();
    source_.cancel();
    if (heating_) link_.cool_down();
    listeners_.message(heating_ ? "stopping: heating ends; once more stops the printer at once"
                                : "stopping: the printer is parked and cooled; once more stops it at once");
  }

  void abort() {
    link_.emergency_stop();
    aborted_ = true;
    loop_.stop();
  }

  asio::awaitable<void> print() {
    if (continuation_ && !continuation_->leg) {
      co_await rejoin();
      if (lost_) co_return;
    } else {
      if (continuation_) spool_->journal().begin_leg(*continuation_->leg);
      co_await link_.connect();
      if (spool_) spool_->supersede_others();
    }
    std::exception_ptr error;
    try {
      if (continuation_) co_await send_spooled();
      if (!continuation_ || spool_->extent().start_lines == 0) co_await start();
      co_await send_pieces();
    } catch (const LinkError&) {
      throw;
    } catch (...) {
      error = std::current_exception();
    }
    // Whatever went wrong, the printer is hot by now and has to be left cold.
    if (stopped_ || error) {
      stopped_ = !error;
      co_await park();
    } else {
      co_await finish();
    }
    if (error) throw PrintError(sentence(error) + "; the print was ended there");
  }

  // ---- going on with a print

  asio::awaitable<void> rejoin() {
    const JournalState& before = spool_->before();
    Rejoined found;
    try {
      found = co_await link_.rejoin(number_beyond(before));
    } catch (const PrinterReset& error) {
      lost_ = Lost{error.what(), std::nullopt};
      co_return;
    }
    lost_ = lost_since(before, found, spool_->chunks(), spool_->extent());
    if (lost_) co_return;
    spool_->journal().begin_session();
    begin_ = place_ = *before.place_of(found.next);
    anew_ = false;
    spool_->journal().anchor({found.next, begin_}, true);
    link_.go_on(found.next);
  }

  void begin_to_catch_up() {
    caught_up_ = false;
    const auto work = [this]() -> asio::awaitable<void> {
      continuation_->catch_up();
      co_return;
    };
    asio::co_spawn(disk_, work, asio::bind_executor(loop_.get_executor(), [this](std::exception_ptr error) {
                     caught_up_ = true;
                     catching_up_failed_ = error;
                     sleep_.notify();
                   }));
  }

  /// Until then the run belongs to another thread.
  asio::awaitable<void> catch_up() {
    const std::function<bool()> caught_up = [this] { return caught_up_; };
    co_await sleep_.wait(TimePoint::max(), caught_up);
  }

  /// What is spooled from here on in this leg.
  asio::awaitable<void> send_spooled() {
    begin_to_catch_up();
    const Leg& leg = continuation_->leg ? *continuation_->leg : spool_->before().leg;
    const std::uint64_t hot = leg.lead_in.empty() ? spool_->extent().start_lines : heat_lines(leg.lead_in);
    LegReader reader(spool_->chunks(), leg, begin_);
    heating_ = begin_ < hot;
    homeless_ = heating_ && !leg.lead_in.empty();
    while (!stopped_) {
      std::vector<std::string> lines = reader.next(heating_ ? std::min(batch, hot - place_) : batch);
      if (lines.empty()) break;
      listeners_.progress(reader.layers_begun(), reader.fraction());
      co_await hand(std::move(lines));
      if (heating_ && place_ >= hot) co_await get_hot();
      homeless_ = homeless_ && stopped_;
    }
    heating_ = false;
    co_await catch_up();
    if (catching_up_failed_) std::rethrow_exception(catching_up_failed_);
  }

  // ---- a print from its beginning, or behind what was spooled

  asio::awaitable<void> start() {
    if (stopped_) co_return;
    gcode::Chunk chunk = source_.start();
    if (!co_await keep({}, chunk)) co_return;
    heating_ = true;
    co_await send(chunk, 0);
    co_await get_hot();
  }

  /// A stop has to know whether that is so.
  asio::awaitable<void> get_hot() {
    if (!stopped_) co_await link_.drain();
    heating_ = false;
  }

  asio::awaitable<void> send_pieces() {
    if (continuation_) sent_ = spool_->extent().layers;
    while (!stopped_) {
      std::optional<Piece> piece = co_await next_piece();
      if (!piece || !co_await keep(std::move(piece->record), piece->chunk)) break;
      co_await send(piece->chunk, sent_++);
    }
  }

  asio::awaitable<void> finish() {
    if (continuation_ && spool_->extent().finished) {
      parked_ = true;
      co_return co_await link_.drain();
    }
    gcode::Chunk chunk;
    try {
      chunk = source_.finish();
    } catch (...) {
      link_.cool_down();
      throw;
    }
    SpooledChunk record;
    record.kind = SpooledChunk::Kind::finish;
    if (!co_await keep(std::move(record), chunk)) co_return co_await send_last(chunk);
    parked_ = std::any_of(chunk.lines.begin(), chunk.lines.end(), moves_away);
    finishing_ = true;
    co_await send(chunk, sent_);
    co_await link_.drain();
    note_progress();
  }

  /// Before its end: these lines are none of the print's own.
  asio::awaitable<void> park() {
    co_await catch_up();
    gcode::Chunk chunk;
    try {
      if (homeless_)
        chunk.lines = {"M104 S0", "M140 S0", "M107"};
      else
        chunk = source_.finish();
    } catch (...) {
      link_.cool_down();
      throw;
    }
    co_await send_last(chunk);
  }

  asio::awaitable<void> send_last(gcode::Chunk& chunk) {
    keep_commands(chunk);
    note_progress();
    if (spool_) spool_->journal().park(chunk.lines);
    parking_ = finishing_ = true;
    parked_ = std::any_of(chunk.lines.begin(), chunk.lines.end(), moves_away);
    co_await send(chunk, sent_);
    co_await link_.drain();
  }

  /// Printer time goes on while this computer plans, unless it is virtual: then it stands still meanwhile,
  /// and what is charged for planning passes afterwards.
  asio::awaitable<std::optional<Piece>> next_piece() {
    const TimePoint asked = clock_->now();
    std::optional<Piece> piece;
    {
      const Clock::Hold hold(*clock_);
      piece = co_await source_.next();
    }
    if (piece) {
      const double ready = computer_.ready(piece->cpu_seconds, seconds(clock_->now() - started_));
      const std::function<bool()> stopped = [this] { return stopped_; };
      co_await sleep_.wait(started_ + duration(ready), stopped);
    }
    waited_ += seconds(clock_->now() - asked);
    co_return piece;
  }

  static double seconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }
  static Duration duration(double seconds) {
    return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
  }

  static void keep_commands(gcode::Chunk& chunk) {
    std::erase_if(chunk.lines, [](const std::string& line) { return !is_command(line); });
  }

  asio::awaitable<void> send(const gcode::Chunk& chunk, std::size_t pieces_done) {
    for (std::size_t i = 0; i < chunk.lines.size() && (finishing_ || !stopped_); i += batch) {
      listeners_.progress(pieces_done, static_cast<double>(i) / static_cast<double>(chunk.lines.size()));
      const std::size_t end = std::min(i + batch, chunk.lines.size());
      co_await hand({chunk.lines.begin() + static_cast<std::ptrdiff_t>(i),
                     chunk.lines.begin() + static_cast<std::ptrdiff_t>(end)});
    }
  }

  asio::awaitable<void> hand(std::vector<std::string> lines) {
    co_await link_.send(std::move(lines));
    if (parking_) co_return;
    place_ = begin_ + link_.statistics().lines;  // without those that a stop has made it forget
    note_progress();
  }

  // ---- the spool

  void keep_journal() {
    link_.on_numbering([this](std::uint32_t number, std::uint64_t line) {
      spool_->journal().anchor({number, begin_ + line}, std::exchange(anew_, false) || number == 1);
    });
  }

  void note_progress() {
    if (!spool_ || parking_) return;
    spool_->journal().progress(place_, std::min(place_, begin_ + link_.statistics().acknowledged));
  }

  void end_journal(const StreamResult& ended) {
    note_progress();
    constexpr std::array outcomes{Outcome::completed, Outcome::stopped, Outcome::failed};
    spool_->journal().end({outcomes.at(static_cast<std::size_t>(ended.ending)), ended.reason});
  }

  /// Strips the chunk of its comments, and spools it. When the disk is full, the print waits until there is
  /// room; false when it was stopped meanwhile, so that nothing of the chunk may be sent.
  asio::awaitable<bool> keep(SpooledChunk record, gcode::Chunk& chunk) {
    if (spool_) record.begun = layers_begun_in(chunk.lines);
    keep_commands(chunk);
    if (!spool_) co_return true;
    record.lines = chunk.lines;
    const std::function<bool()> stopped = [this] { return stopped_; };
    for (bool told = false;; told = true) {
      const std::string problem = co_await write(record);
      if (problem.empty()) co_return true;
      if (!told) listeners_.message("Error: the print waits: " + problem);
      if (co_await sleep_.wait(clock_->now() + full_disk_pause, stopped)) co_return false;
    }
  }

  /// Off the loop. Returns why it could not be done, if so.
  asio::awaitable<std::string> write(const SpooledChunk& record) {
    const Clock::Hold hold(*clock_);
    const auto work = [&]() -> asio::awaitable<std::string> {
      try {
        spool_->append(record);
      } catch (const SpoolFull& error) {
        co_return error.what();
      }
      co_return std::string();
    };
    co_return co_await asio::co_spawn(disk_, work, asio::use_awaitable);
  }

  asio::io_context loop_{1};
  asio::thread_pool disk_{1};
  Source& source_;
  const StreamListeners& listeners_;
  Spool* const spool_;
  const std::optional<Continuation> continuation_;
  const std::shared_ptr<Clock> clock_;
  const TimePoint started_ = clock_->now();
  SlowComputer computer_;
  asio::signal_set signals_;
  Signal sleep_;
  Link link_;
  std::uint64_t begin_ = 0;  ///< place in the leg at which this program begins
  std::uint64_t place_ = 0;  ///< before which everything was handed to the link
  bool anew_ = true;         ///< the next numbering is the first
  bool caught_up_ = true;
  std::exception_ptr catching_up_failed_;
  bool stopped_ = false;
  bool finishing_ = false;
  bool parking_ = false;  ///< what is sent is not of the spool
  bool aborted_ = false;
  bool heating_ = false;  ///< the start is under way
  bool parked_ = false;
  bool homeless_ = false;  ///< the printer does not know where its nozzle is: it must not move
  std::size_t sent_ = 0;   ///< pieces begun
  double waited_ = 0;      ///< s for pieces
  std::optional<Lost> lost_;
};

}  // namespace

StreamResult stream(int port, Lookahead& lookahead, Run& run, const StreamListeners& listeners,
                    const StreamSettings& settings) {
  PlannedSource source(lookahead, run, settings.spool != nullptr);
  return Stream(port, source, listeners, settings)();
}

StreamResult stream(int port, const FinishedPrint& print, const StreamListeners& listeners,
                    const StreamSettings& settings) {
  FinishedSource source(print);
  return Stream(port, source, listeners, settings)();
}

}  // namespace unicursal::host
