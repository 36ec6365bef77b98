#include "host/feeding/cool_when_back.hpp"

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>
#include <asio/use_awaitable.hpp>
#include <chrono>
#include <exception>
#include <functional>
#include <vector>

#include "host/engine/reconnecting.hpp"
#include "host/loop/print_signals.hpp"

namespace unicursal::host {
namespace {

using Time = std::chrono::steady_clock;

constexpr auto look_again_for_port = std::chrono::milliseconds(300);

/// Returns false while the port or the printer is not there.
asio::awaitable<bool> try_to_cool(asio::any_io_executor executor, const std::string& port, unsigned baud,
                                  LinkOptions options) {
  try {
    const int descriptor = open_port(port, baud, options);
    Link link(executor, descriptor, options);
    co_await link.connect();
    std::vector<std::string> lines{"M104 S0", "M140 S0"};
    co_await link.send(std::move(lines));
    co_await link.drain();
  } catch (const LinkError&) {
    co_return false;
  }
  co_return true;
}

asio::awaitable<bool> cool_in_time(asio::any_io_executor executor, const std::string& port, unsigned baud,
                                   const LinkOptions& options) {
  asio::steady_timer timer(executor);
  const auto end = Time::now() + reconnecting_patience;
  while (Time::now() < end) {
    if (co_await try_to_cool(executor, port, baud, options)) co_return true;
    timer.expires_after(look_again_for_port);
    co_await timer.async_wait(asio::use_awaitable);
  }
  co_return false;
}

std::string reason_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& failure) {
    return failure.what();
  }
}

}  // namespace

Cooling cool_when_back(const std::string& port, unsigned baud, LinkOptions options) {
  options.temperatures = {};
  asio::io_context loop{1};
  asio::signal_set signals(loop);
  const PrintSignals rules(signals);
  // A closed terminal may send its signal twice, and is no reason to leave the printer hot.
  const std::function<void()> await_signal = [&] {
    signals.async_wait([&](const asio::error_code& error, int signal) {
      if (error) return;
      if (!PrintSignals::counts_again(signal)) return await_signal();
      loop.stop();
    });
  };
  await_signal();
  Cooling cooling{Cooling::Ending::gave_up, "the waiting was stopped"};
  asio::co_spawn(loop, cool_in_time(loop.get_executor(), port, baud, options),
                 [&](const std::exception_ptr& error, bool back) {
                   if (error) {
                     cooling.reason = reason_of(error);
                   } else {
                     cooling = {back ? Cooling::Ending::cooled : Cooling::Ending::time_over, ""};
                   }
                   loop.stop();
                 });
  loop.run();
  return cooling;
}

}  // namespace unicursal::host
