// What `unicursal serve` says about its page.
#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using test::Terminal;

TEST_CASE("serve shows a terminal the page's address with the token, and keeps the token out of files") {
  const test::TempFolder folder;
  const std::string state = (folder / "state").string();
  {
    Terminal terminal({"serve", "--listen", "127.0.0.1:0", "--state", state}, "/nonexistent", {160});
    terminal.await("listening on http://127.0.0.1:");
    terminal.await("open http://127.0.0.1:");
    terminal.await("/#token=" + test::read_text(state + "/token").substr(0, 64));
    terminal.type("\x03");
    CHECK(terminal.wait() == 0);
  }
  test::DaemonBench bench;
  bench.serve();
  kill(bench.daemon().id(), SIGTERM);
  bench.daemon().wait();
  CHECK((bench.daemon().out() + bench.daemon().err()).find(bench.token()) == std::string::npos);
  CHECK(bench.daemon().out().find("the token is in " + bench.path("state") + "/token") != std::string::npos);
}

TEST_CASE("serve without a token shows the page's address without one") {
  const test::TempFolder folder;
  Terminal terminal(
      {"serve", "--listen", "127.0.0.1:0", "--no-token", "--state", (folder / "state").string()},
      "/nonexistent", {160});
  terminal.await("open http://127.0.0.1:");
  terminal.type("\x03");
  CHECK(terminal.wait() == 0);
  for (const std::string& row : terminal.screen().rows()) CHECK(row.find("token=") == std::string::npos);
}
