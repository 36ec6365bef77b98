// How tests use an idle printer: connect it, do something with it, close its connection.
#pragma once

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <exception>
#include <functional>
#include <string>

#include "host/idle/idle_printer.hpp"

namespace unicursal::test {

using IdleScript = std::function<asio::awaitable<void>(host::IdlePrinter&)>;

struct IdlePort {
  const host::Profile& profile;
  std::string name;
};

/// `bench.until(condition)` waits until something is so; `run` runs the loop. Throws what the script throws.
template <class Bench>
void with_idle_printer(asio::io_context& loop, host::IdlePrinter& idle, const IdlePort& port, Bench& bench,
                       const IdleScript& script, const std::function<void()>& run) {
  std::exception_ptr failure;
  const auto all = [&]() -> asio::awaitable<void> {
    idle.connect(port.profile, port.name);
    co_await bench.until([&] { return idle.status().connection == host::IdleStatus::Connection::open; });
    co_await script(idle);
    co_await idle.close();
  };
  asio::co_spawn(loop, all, [&](const std::exception_ptr& error) {
    failure = error;
    loop.stop();
  });
  run();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace unicursal::test
