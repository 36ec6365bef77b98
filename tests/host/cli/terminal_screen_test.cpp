// What a person sees of a print in terminals of 60, 80 and 120 columns.
#include <catch2/catch.hpp>
#include <memory>

#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;
using test::Child;
using test::Terminal;
using test::TerminalKind;

namespace {

/// A job, and a simulated printer for it.
class Bench {
 public:
  explicit Bench(const std::string& job = test::tall_job(), const char* speed = "100") {
    folder_.write("bench.toml", test::tall_profile());
    folder_.write("plate.svg", test::sample_drawing);
    folder_.write("job.toml", job);
    printer_ = std::make_unique<Child>(std::vector<std::string>{"simulate", "--profile", path("bench.toml"),
                                                                "--link", path("port"), "--speed", speed});
    test::await([&] { return std::filesystem::exists(folder_ / "port"); }, *printer_);
  }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::vector<std::string> print(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"print",      path("job.toml"), "--port",
                                      path("port"), "--spool",        path("spool")};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

 private:
  test::TempFolder folder_;
  std::unique_ptr<Child> printer_;
};

}  // namespace

TEST_CASE("the progress of a print fits a window of 60, 80 or 120 columns", "[optimised]") {
  const auto [width, fields] =
      GENERATE(table<int, std::string>({{60, " left"}, {80, " ahead"}, {120, "nozzle "}}));
  const Bench bench(test::tall_job(), "50");
  Terminal terminal(bench.print(), "/nonexistent", {static_cast<unsigned short>(width)});
  terminal.await("heating, ");
  terminal.await(" left");  // heating is a part of it
  terminal.await("printing layer 2");
  terminal.await("printing layer 3");
  CHECK_THAT(terminal.screen().last_row("printing layer"), Contains(fields) && Contains(" %"));
  CHECK(terminal.screen().broken_rows() == 0);
  terminal.resize(50);
  terminal.await("printing layer 5");
  terminal.await("printing layer 6");
  CHECK(terminal.screen().last_row("printing layer").size() < 50);
  CHECK(terminal.screen().broken_rows() == 0);
  terminal.type("\x03");
  CHECK(terminal.wait() == 3);
}

TEST_CASE("what a person types stands on a line of its own, and every command is answered") {
  const int width = GENERATE(60, 80, 120);
  const Bench bench;
  Terminal terminal(bench.print(), "/nonexistent", {static_cast<unsigned short>(width)});
  terminal.await("printing layer 1");
  terminal.type("speed 1");
  terminal.await("> speed 1");
  terminal.await("printing layer 3");  // the line was rewritten many times meanwhile
  CHECK(terminal.screen().last_row("> ") == "> speed 1");
  terminal.type(
      "5\x7f"
      "20\n");
  terminal.await("speed is 120 % now");
  terminal.type("flow 5\n");
  terminal.await("not between 50 and 200");
  terminal.type("nozzle 203\n");
  terminal.await("the nozzle is set to 203 °C now");
  terminal.type("pause\n");
  terminal.await("the print pauses in a moment");
  terminal.await("paused layer");
  terminal.type("what?\n");
  terminal.await("type pause, resume, cancel");
  terminal.type("resume\n");
  terminal.await("the print goes on");
  terminal.await("printing layer");
  terminal.type("\x03");
  CHECK(terminal.wait() == 3);
  const auto rows = terminal.screen().rows();
  const auto row = [&](const char* text) { return std::find(rows.begin(), rows.end(), text) - rows.begin(); };
  const auto all = static_cast<std::ptrdiff_t>(rows.size());
  CHECK(row("> speed 120") < all);
  CHECK(row("> speed 120") + 1 == row("speed is 120 % now"));
  CHECK(row("> pause") < row("> resume"));
  CHECK(terminal.screen().last_row("printing layer").empty());  // nothing stale stays
}

TEST_CASE("a print says when and after how long it was done, what had been foretold and what it used") {
  const int width = GENERATE(60, 80, 120);
  const Bench bench(test::sample_job, "200");
  Terminal terminal(bench.print(), "/nonexistent", {static_cast<unsigned short>(width)});
  CHECK(terminal.wait() == 0);
  const std::string done = terminal.screen().last_row("done at ");
  CHECK_THAT(done, Contains(", after ") && Contains(" had been foretold"));
  CHECK_THAT(terminal.screen().last_row("filament: "), Contains(" feeder 1: ") && Contains(" m, "));
  CHECK_THAT(terminal.screen().last_row("material: "), Contains("sea"));
}

TEST_CASE("swatches of mixtures need a terminal with colours and no NO_COLOR", "[optimised]") {
  const Bench bench(test::sample_job, "200");
  using Environment = std::map<std::string, std::string>;
  const auto [width, environment, coloured] = GENERATE(
      table<int, Environment, bool>({{60, {{"COLORTERM", "truecolor"}}, true},
                                     {80, {{"TERM", "xterm-256color"}}, true},
                                     {120, {{"COLORTERM", "truecolor"}}, true},
                                     {60, {{"COLORTERM", "truecolor"}, {"NO_COLOR", "1"}}, false},
                                     {80, {{"TERM", "vt100"}}, false},
                                     {120, {{"TERM", "xterm-256color"}, {"NO_COLOR", "1"}}, false}}));
  Terminal terminal(bench.print(), "/nonexistent", {static_cast<unsigned short>(width), environment});
  CHECK(terminal.wait() == 0);
  CHECK((terminal.screen().colours() > 0) == coloured);
}

TEST_CASE("a dumb terminal gets whole lines") {
  const int width = GENERATE(60, 80, 120);
  const Bench bench(test::sample_job, "200");
  Terminal terminal(bench.print(), "/nonexistent", {static_cast<unsigned short>(width), {{"TERM", "dumb"}}});
  terminal.await("printing layer");
  CHECK(terminal.wait() == 0);
  CHECK(terminal.screen().sequences() == 0);
}

TEST_CASE("a dry run shows its own progress, and the print's time at the end", "[optimised]") {
  const int width = GENERATE(60, 80, 120);
  const Bench bench(test::replaced(test::sample_job, "height = 0.4", "height = 8.0"));
  Terminal terminal({"dry-run", bench.path("job.toml")}, "/nonexistent",
                    {static_cast<unsigned short>(width)});
  terminal.await("dry run layer");
  CHECK(terminal.wait() == 0);
  CHECK(terminal.screen().last_row("printing layer").empty());
  CHECK_THAT(terminal.screen().last_row("done: "),
             Contains("the print takes ") && Contains("with heating ("));
  CHECK(terminal.screen().last_row("dry run").empty());
}
