#include "host/engine/stream.hpp"

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <csignal>
#include <exception>
#include <new>

#include "host/engine/slow_computer.hpp"
#include "host/link/signal.hpp"

namespace unicursal::host {
namespace {

/// Lines handed to the link at once: few, so that a stop takes effect soon.
constexpr std::size_t batch = 16;

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

/// A stretch of the print and what planning it has cost, in s of this computer's processors.
struct Piece {
  gcode::Chunk chunk;
  double cpu_seconds = 0;
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
  PlannedSource(Lookahead& lookahead, Run& run) : lookahead_(lookahead), run_(run) {}

  const gcode::Chunk& start() override { return run_.start(); }
  asio::awaitable<std::optional<Piece>> next() override {
    std::optional<PlannedLayer> layer = co_await lookahead_.next();
    if (!layer) co_return std::nullopt;
    const double cost = layer->cpu_seconds;
    co_return Piece{run_.layer(std::move(*layer)), cost};
  }
  gcode::Chunk finish() override { return run_.finish(); }
  void cancel() override { lookahead_.cancel(); }
  SlowComputer computer(double charge) const override {
    return {charge, lookahead_.threads(), lookahead_.ahead()};
  }

 private:
  Lookahead& lookahead_;
  Run& run_;
};

class FinishedSource final : public Source {
 public:
  explicit FinishedSource(const FinishedPrint& print) : print_(print) {}

  const gcode::Chunk& start() override { return print_.start; }
  asio::awaitable<std::optional<Piece>> next() override {
    if (taken_ == print_.body.size()) co_return std::nullopt;
    co_return Piece{print_.body[taken_++]};
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
        clock_(settings.clock),
        computer_(source.computer(settings.charge)),
        signals_(loop_, SIGINT, SIGTERM),
        sleep_(loop_.get_executor(), clock_),
        link_(loop_.get_executor(), port, options(clock_)) {
    if (!is_ignored(SIGHUP)) signals_.add(SIGHUP);
  }

  StreamResult operator()() {
    std::exception_ptr error;
    link_.on_message(listeners_.message);
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
    return result(error);
  }

 private:
  static LinkOptions options(const std::shared_ptr<Clock>& clock) {
    LinkOptions options;
    options.clock = clock;
    return options;
  }

  StreamResult result(const std::exception_ptr& error) const {
    StreamResult result{Ending::completed, {}, parked_, link_.statistics(), link_.firmware(), waited_};
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
    co_await link_.connect();
    std::exception_ptr error;
    try {
      co_await start();
      co_await send_pieces();
    } catch (const LinkError&) {
      throw;
    } catch (...) {
      error = std::current_exception();
    }
    // Whatever went wrong, the printer is hot by now and has to be left cold.
    if (error) stopped_ = false;
    co_await finish();
    if (error) throw PrintError(sentence(error) + "; the print was ended there");
  }

  asio::awaitable<void> start() {
    heating_ = true;
    co_await send(source_.start(), 0);
    if (!stopped_) co_await link_.drain();  // until hot: a stop has to know whether that is so
    heating_ = false;
  }

  asio::awaitable<void> finish() {
    finishing_ = true;
    try {
      const gcode::Chunk chunk = source_.finish();
      parked_ = std::any_of(chunk.lines.begin(), chunk.lines.end(), moves_away);
      co_await send(chunk, sent_);
    } catch (const LinkError&) {
      throw;
    } catch (...) {
      link_.cool_down();
      throw;
    }
    co_await link_.drain();
  }

  asio::awaitable<void> send_pieces() {
    while (!stopped_) {
      std::optional<Piece> piece = co_await next_piece();
      if (!piece) break;
      co_await send(std::move(piece->chunk), sent_++);
    }
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

  asio::awaitable<void> send(gcode::Chunk chunk, std::size_t pieces_done) {
    std::erase_if(chunk.lines, [](const std::string& line) { return !is_command(line); });
    for (std::size_t i = 0; i < chunk.lines.size() && (finishing_ || !stopped_); i += batch) {
      listeners_.progress(pieces_done, static_cast<double>(i) / static_cast<double>(chunk.lines.size()));
      const std::size_t end = std::min(i + batch, chunk.lines.size());
      std::vector<std::string> lines(chunk.lines.begin() + static_cast<std::ptrdiff_t>(i),
                                     chunk.lines.begin() + static_cast<std::ptrdiff_t>(end));
      co_await link_.send(std::move(lines));
    }
  }

  asio::io_context loop_{1};
  Source& source_;
  const StreamListeners& listeners_;
  const std::shared_ptr<Clock> clock_;
  const TimePoint started_ = clock_->now();
  SlowComputer computer_;
  asio::signal_set signals_;
  Signal sleep_;
  Link link_;
  bool stopped_ = false;
  bool finishing_ = false;
  bool aborted_ = false;
  bool heating_ = false;  ///< the start is under way
  bool parked_ = false;
  std::size_t sent_ = 0;  ///< pieces begun
  double waited_ = 0;     ///< s for pieces
};

}  // namespace

StreamResult stream(int port, Lookahead& lookahead, Run& run, const StreamListeners& listeners,
                    const StreamSettings& settings) {
  PlannedSource source(lookahead, run);
  return Stream(port, source, listeners, settings)();
}

StreamResult stream(int port, const FinishedPrint& print, const StreamListeners& listeners,
                    const StreamSettings& settings) {
  FinishedSource source(print);
  return Stream(port, source, listeners, settings)();
}

}  // namespace unicursal::host
