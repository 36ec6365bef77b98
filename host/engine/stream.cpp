#include "host/engine/stream.hpp"

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <csignal>
#include <exception>

namespace unicursal::host {
namespace {

/// Lines handed to the link at once: few, so that a stop takes effect soon.
constexpr std::size_t batch = 16;

class Stream {
 public:
  Stream(int port, Lookahead& lookahead, Run& run, const StreamListeners& listeners)
      : lookahead_(lookahead),
        run_(run),
        listeners_(listeners),
        signals_(loop_, SIGINT, SIGTERM),
        link_(loop_.get_executor(), port, LinkOptions{}) {}

  StreamResult operator()() {
    std::exception_ptr error;
    link_.on_message(listeners_.message);
    await_signal();
    asio::co_spawn(loop_, print(), [&](std::exception_ptr thrown) {
      error = thrown;
      loop_.stop();
    });
    loop_.run();
    if (error) std::rethrow_exception(error);
    if (aborted_) throw PrintError("stopped at once; reset the printer before using it again");
    return {stopped_, link_.statistics(), link_.firmware()};
  }

 private:
  void await_signal() {
    signals_.async_wait([this](const asio::error_code& error, int) {
      if (error) return;
      if (stopped_) return abort();
      stopped_ = true;
      lookahead_.cancel();
      listeners_.message("stopping: the printer is parked and cooled; once more stops it at once");
      await_signal();
    });
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
      co_await send(run_.start(), 0);
      co_await send_layers();
    } catch (const core::DataError&) {
      error = std::current_exception();
    }
    // Whatever the data may hold, the printer is hot by now and has to be left cold.
    if (error) stopped_ = false;
    finishing_ = true;
    co_await send(run_.finish(), run_.totals().layers);
    co_await link_.drain();
    if (error) rethrow_as_print_error(error);
  }

  asio::awaitable<void> send_layers() {
    for (std::size_t done = 0; !stopped_; ++done) {
      std::optional<PlannedLayer> layer = co_await lookahead_.next();
      if (!layer) break;
      co_await send(run_.layer(std::move(*layer)), done);
    }
  }

  asio::awaitable<void> send(gcode::Chunk chunk, std::size_t layers_done) {
    std::erase_if(chunk.lines, [](const std::string& line) { return !is_command(line); });
    for (std::size_t i = 0; i < chunk.lines.size() && (finishing_ || !stopped_); i += batch) {
      listeners_.progress(layers_done, static_cast<double>(i) / static_cast<double>(chunk.lines.size()));
      const std::size_t end = std::min(i + batch, chunk.lines.size());
      std::vector<std::string> lines(chunk.lines.begin() + static_cast<std::ptrdiff_t>(i),
                                     chunk.lines.begin() + static_cast<std::ptrdiff_t>(end));
      co_await link_.send(std::move(lines));
    }
  }

  [[noreturn]] static void rethrow_as_print_error(const std::exception_ptr& error) {
    try {
      std::rethrow_exception(error);
    } catch (const core::DataError& data) {
      throw PrintError(std::string(data.what()) + "; the print was ended there");
    }
  }

  asio::io_context loop_{1};
  Lookahead& lookahead_;
  Run& run_;
  const StreamListeners& listeners_;
  asio::signal_set signals_;
  Link link_;
  bool stopped_ = false;
  bool finishing_ = false;
  bool aborted_ = false;
};

}  // namespace

StreamResult stream(int port, Lookahead& lookahead, Run& run, const StreamListeners& listeners) {
  return Stream(port, lookahead, run, listeners)();
}

}  // namespace unicursal::host
