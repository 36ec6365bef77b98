// Rejoining a printer that another program was printing on when it died, with the project's own simulated
// printers in a process of their own.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <catch2/catch.hpp>
#include <exception>

#include "host/link/ledger.hpp"
#include "host/link/link.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;

namespace {

class Printer {
 public:
  explicit Printer(const std::string& personality)
      : child_({"simulate", "--link", link(), "--transcript", (folder_ / "t").string(), "--personality",
                personality}) {
    while (!std::filesystem::exists(link())) {
      REQUIRE(child_.running());
      poll(nullptr, 0, 5);
    }
  }
  std::string link() const { return folder_ / "port"; }
  /// Ends it; returns the commands that it has executed, without the link's own questions.
  std::vector<std::string> executed() {
    kill(child_.id(), SIGTERM);
    child_.wait();
    std::istringstream transcript(test::read_text(folder_ / "t"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(transcript, line);) {
      if (line.rfind("M1", 0) != 0 && line != "*") lines.push_back(line);
    }
    return lines;
  }

 private:
  test::TempFolder folder_;
  test::Child child_;
};

std::vector<std::string> moves(std::size_t count) {
  std::vector<std::string> lines{"G28"};
  for (std::size_t i = 1; i < count; ++i) lines.push_back(fmt::format("G1 X{} Y{} F9000", i % 100, i % 7));
  return lines;
}

LinkOptions impatient() {
  LinkOptions options;
  options.boot = std::chrono::milliseconds(500);
  options.silence = std::chrono::milliseconds(1000);  // a Repetier whose clock stands still may not answer
  return options;
}

/// Runs `talk` with a link to the printer, and then hangs up at once.
void with_link(const Printer& printer, const std::function<asio::awaitable<void>(Link&)>& talk) {
  asio::io_context loop;
  std::exception_ptr error;
  Link link(loop.get_executor(), open_port(printer.link(), 250000), impatient());
  asio::co_spawn(loop, talk(link), [&](std::exception_ptr thrown) {
    error = thrown;
    loop.stop();
  });
  loop.run();
  if (error) std::rethrow_exception(error);
}

}  // namespace

TEST_CASE("a second program continues where the first one died, no line is lost or executed twice") {
  for (const char* personality : {"marlin", "marlin-advanced-ok", "repetier"}) {
    INFO(personality);
    Printer printer(personality);
    const std::vector<std::string> lines = moves(400);
    with_link(printer, [&](Link& link) -> asio::awaitable<void> {
      co_await link.connect();
      co_await link.send({lines.begin(), lines.begin() + 250});
    });
    // Half a line, as from a program that is killed while it writes.
    const int port = open_port(printer.link(), 250000);
    const std::string half = framed(251, lines[250]).substr(0, 9);
    REQUIRE(::write(port, half.data(), half.size()) == static_cast<ssize_t>(half.size()));
    ::close(port);
    std::uint32_t next = 0;
    with_link(printer, [&](Link& link) -> asio::awaitable<void> {
      const Rejoined found = co_await link.rejoin(20000);
      next = found.next;
      REQUIRE(next > 200);
      REQUIRE(next <= 251);
      const std::size_t last = next - 2;  // `next` counts from 1, and has not been executed yet
      REQUIRE(found.position);
      CHECK((*found.position)[0] == Approx(last % 100));
      CHECK((*found.position)[1] == Approx(last % 7));
      CHECK(found.temperatures.nozzle_target == 0.0);
      link.go_on(next);
      co_await link.send({lines.begin() + next - 1, lines.end()});
      co_await link.drain();
    });
    CHECK(printer.executed() == lines);
  }
}

TEST_CASE("the questions change nothing, however often they are asked") {
  Printer printer("marlin");
  const std::vector<std::string> lines = moves(60);
  with_link(printer, [&](Link& link) -> asio::awaitable<void> {
    co_await link.connect();
    co_await link.send(lines);
    co_await link.drain();
  });
  for (int i = 0; i < 3; ++i) {
    with_link(printer, [&](Link& link) -> asio::awaitable<void> {
      const Rejoined found = co_await link.rejoin(20000);
      CHECK(found.next == 61);
    });
  }
  CHECK(printer.executed() == lines);
}

TEST_CASE("lines that the link inserts shift the numbers, which is reported before they are written") {
  Ledger ledger(127, 40);
  for (int i = 0; i < 3; ++i) ledger.push("G1 X1");
  std::string bytes;
  ledger.fill(bytes);
  CHECK(bytes.rfind("N40 ", 0) == 0);
  CHECK(ledger.next_to_number() == 43);
  CHECK(ledger.numbered() == 3);
  ledger.rewind(42);
  ledger.fence();
  CHECK(ledger.next_to_number() == 44);
  CHECK(ledger.numbered() == 3);
}
