#include "host/loop/signal.hpp"

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/io_context.hpp>
#include <catch2/catch.hpp>
#include <optional>

namespace unicursal::host {

TEST_CASE("A signal asks nobody who was destroyed while he waited") {
  std::optional<asio::io_context> loop(std::in_place);
  Signal signal(loop->get_executor(), real_clock());
  int asked = 0;
  const std::function<bool()> ready = [&asked] { return ++asked, false; };
  asio::co_spawn(*loop, signal.wait(real_clock()->now() + std::chrono::hours(1), ready), asio::detached);
  loop->poll();
  signal.notify();
  CHECK(asked == 2);  // before it waited, and now
  loop.reset();       // with its coroutines
  signal.notify();
  CHECK(asked == 2);
}

}  // namespace unicursal::host
