// Prints of models, for which no job was written: real processes.
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/host/support/print_bench.hpp"

namespace unicursal {
namespace {

using test::Child;
using test::Outcome;
using Bench = test::PrintBench;

std::vector<std::string> print_model(const Bench& bench) {
  return {"print",         bench.path("plate.svg"),
          "--profile",     bench.path("bench.toml"),
          "--port",        bench.path("port"),
          "--spool",       bench.path("spool"),
          "--layers",      "0:1",
          "--full-quality"};
}

/// Whether a line of a layer can have been sent.
bool laying(const Bench& bench) {
  std::error_code none;
  return bench.begun() && !std::filesystem::exists(bench.print_folder() / "untouched", none);
}

}  // namespace

TEST_CASE("a model is printed like a job, and resumed from the copy of it after its host is killed") {
  Bench whole(0);
  const Outcome undisturbed = test::run(print_model(whole));
  INFO(undisturbed.err);
  REQUIRE(undisturbed.code == 0);
  Bench bench(60);
  {
    Child host(print_model(bench));
    Bench::wait_for([&] { return laying(bench); }, host);
    REQUIRE(host.running());
    kill(host.id(), SIGKILL);
    host.wait();
  }
  bench.folder().write("plate.svg", "<svg/>");
  bench.folder().write("bench.toml", "");
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  test::check_equal(bench.seen(), whole.seen());
}

}  // namespace unicursal
