#include "host/engine/reconnecting.hpp"

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <asio/redirect_error.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>
#include <asio/this_coro.hpp>
#include <asio/thread_pool.hpp>
#include <asio/use_awaitable.hpp>
#include <exception>
#include <utility>

#include "host/loop/print_signals.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;
using Time = std::chrono::steady_clock;

constexpr auto look_again = 300ms;

/// Returns false while the port is not there.
asio::awaitable<bool> try_once(Print& print) {
  try {
    print.reconnect();
  } catch (const PortError&) {
    co_return false;
  }
  co_return true;
}

}  // namespace

asio::awaitable<bool> reconnect(Print& print, asio::any_io_executor opener, std::stop_token stop) {
  asio::steady_timer timer(co_await asio::this_coro::executor);
  const std::stop_callback waking(stop, [&timer] { timer.cancel(); });
  const auto end = Time::now() + reconnecting_patience;
  while (Time::now() < end && !stop.stop_requested()) {
    if (co_await asio::co_spawn(opener, try_once(print), asio::use_awaitable)) co_return true;
    if (stop.stop_requested()) break;
    timer.expires_after(look_again);
    asio::error_code woken;
    co_await timer.async_wait(asio::redirect_error(asio::use_awaitable, woken));
  }
  co_return false;
}

bool reconnect_in_foreground(Print& print) {
  asio::io_context loop{1};
  asio::thread_pool opener(1);
  std::stop_source stop;
  asio::signal_set signals(loop);
  const PrintSignals rules(signals);
  signals.async_wait([&stop](const asio::error_code& error, int) {
    if (!error) stop.request_stop();
  });
  bool back = false;
  std::exception_ptr failure;
  asio::co_spawn(loop, reconnect(print, opener.get_executor(), stop.get_token()),
                 [&](const std::exception_ptr& error, bool connected) {
                   failure = error;
                   back = connected;
                   loop.stop();
                 });
  loop.run();
  if (failure) std::rethrow_exception(failure);
  return back;
}

StreamResult as_failure(StreamResult result) {
  if (!result.lost) return result;
  result.ending = Ending::failed;
  result.reason = "the printer is back, but the print cannot simply go on: " + result.lost->why;
  return result;
}

}  // namespace unicursal::host
