#include "host/cli/wrapped.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/host/support/terminal.hpp"

namespace unicursal::host {

TEST_CASE("lines that are too wide are broken between words") {
  CHECK(wrapped("the nozzle is cold", 18) == "the nozzle is cold");
  CHECK(wrapped("the nozzle is cold", 17) == "the nozzle is\ncold");
  CHECK(wrapped("the nozzle is cold\n", 10) == "the nozzle\nis cold\n");
  CHECK(wrapped("a line\n\nand another one\n", 11) == "a line\n\nand another\none\n");
  CHECK(wrapped("grüße an den drucker", 12) == "grüße an den\ndrucker");  // 14 bytes
}

TEST_CASE("what cannot be broken keeps a line of its own") {
  CHECK(wrapped("see /a/long/name/of/a/file for more", 12) == "see\n/a/long/name/of/a/file\nfor more");
  CHECK(wrapped("look with `unicursal status --daemon` and wait", 20) ==
        "look with\n`unicursal status --daemon`\nand wait");
  CHECK(wrapped("one ` alone does not bind words", 12) == "one ` alone\ndoes not\nbind words");
}

TEST_CASE("a broken line keeps its blanks: those at its beginning, and those between columns") {
  CHECK(wrapped("  select  a part of the model", 18) == "  select  a part\n  of the model");
  CHECK(wrapped("speed [50]: ", 11) == "speed [50]:");
  CHECK(wrapped(std::string(30, ' '), 10) == std::string(30, ' '));
}

TEST_CASE("sentences of errors, notes and lists fit narrow windows") {
  const auto width = GENERATE(std::size_t{60}, std::size_t{80}, std::size_t{120});
  const test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  folder.write("plate.svg", test::sample_drawing);
  folder.write("job.toml", std::string(test::sample_job) + "\norange = 5\n");
  const auto check = [&](std::vector<std::string> words, const std::string& sentence) {
    test::Terminal terminal(std::move(words), "/nonexistent", {static_cast<unsigned short>(width)});
    terminal.wait();
    CHECK(terminal.screen().broken_rows() == 0);
    std::string text = terminal.screen().text();
    std::replace(text.begin(), text.end(), '\n', ' ');
    CHECK_THAT(text, Catch::Matchers::Contains(sentence));
  };
  const auto path = [&](const char* name) { return (folder / name).string(); };
  check({"dry-run", path("job.toml")}, "write one share of 0 or more for each of the 3 feeders");
  check({"simulate", "--profile", path("bench.toml"), "--fault", "nonsense"}, "bitflip");
  check({"status", "--state", path("nowhere")},
        "no daemon runs with this state folder; start one with `unicursal serve`");
}

}  // namespace unicursal::host
