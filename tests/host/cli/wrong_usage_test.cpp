// What the program says to words that it does not understand: one sentence, and one hint.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using test::Outcome;
using test::run;
using Words = std::vector<std::string>;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// One line that begins with the program's name and has one hint, in a pipe and in windows of three widths.
void check_one_hint(const Words& words) {
  std::string command;
  for (const std::string& word : words) command += ' ' + word;
  const Outcome outcome = run(words);
  INFO("unicursal" << command << "\n" << outcome.out << outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.starts_with("unicursal: "));
  CHECK(count(outcome.err, "\n") == 1);
  std::size_t hints = 0;
  for (const char* hint : {"did you mean", "see `", " lists the ", "the names are", "the kinds are"})
    hints += count(outcome.err, hint);
  CHECK(hints <= 1);
  CHECK(outcome.err.find("; ") != std::string::npos);
  for (const std::size_t width : {60, 80, 120}) {
    test::Terminal terminal(words, "/nonexistent", {static_cast<unsigned short>(width)});
    CHECK(terminal.wait() == 2);
    const auto rows = terminal.screen().rows();
    const auto first = std::find_if(rows.begin(), rows.end(),
                                    [](const auto& row) { return row.starts_with("unicursal: "); });
    REQUIRE(first != rows.end());
    // The window breaks the line, and the last row is empty. Nothing else is said.
    CHECK(std::size_t(rows.end() - first) == (outcome.err.size() - 2) / width + 2);
  }
}

/// What the program says to these words, without its name and the line end.
std::string said(const Words& words) {
  const Outcome outcome = run(words);
  CHECK(outcome.code == 2);
  return outcome.err.size() < 12 ? outcome.err : outcome.err.substr(11, outcome.err.size() - 12);
}

}  // namespace

TEST_CASE("a mistyped option, command or word is named, with what was probably meant") {
  for (const auto& [words, sentence] : std::vector<std::pair<Words, std::string>>{
           {{"print", "--prt", "x"}, "print: \"--prt\" is not an option; did you mean \"--port\"?"},
           {{"plan", "a.toml", "--layer", "0:1"},
            "plan: \"--layer\" is not an option; did you mean \"--layers\"?"},
           {{"dry-run", "--pers", "x"},
            "dry-run: \"--pers\" is not an option; did you mean \"--personality\"?"},
           {{"queue", "--uplaod=x"}, "queue: \"--uplaod\" is not an option; did you mean \"--upload\"?"},
           {{"--vers"}, "\"--vers\" is not an option; did you mean \"--version\"?"},
           {{"print", "--nonsense"},
            "print: \"--nonsense\" is not an option; `unicursal print --help` lists the options"},
           {{"ports", "-x"}, "ports: \"-x\" is not an option; `unicursal ports --help` lists the options"},
           {{"prnt", "--help"}, "\"prnt\" is not a command; did you mean \"print\"?"},
           {{"fly"}, "\"fly\" is not a command; `unicursal --help` lists the commands"},
           {{"tune", "transitoin"}, "tune: \"transitoin\" is not a command; did you mean \"transition\"?"},
           {{}, "a command is missing; `unicursal --help` lists the commands"},
           {{"tune"}, "tune: a command is missing; `unicursal tune --help` lists the commands"},
           {{"set", "speed", "80"},
            "set: the word \"speed\" is not expected here; did you mean \"--speed\"?"},
           {{"print", "a.toml", "b.toml"},
            "print: the word \"b.toml\" is not expected here; see `unicursal print --help`"},
           {{"print"}, "print: JOB is missing; see `unicursal print --help`"},
           {{"serve", "--port"}, "serve: --port: its value is missing; see `unicursal serve --help`"},
           {{"print", "a.toml", "--threads", "many"},
            "print: --threads: \"many\" is not a whole number from 1 to 256; see `unicursal print --help`"},
           {{"queue", "--add", "a", "--upload", "b"},
            "queue: --add cannot be given together with --upload; see `unicursal queue --help`"}})
    CHECK(said(words) == sentence);
}

TEST_CASE("every refusal has one hint") {
  const test::TempFolder folder;
  const auto path = [&](const char* name) { return (folder / name).string(); };
  folder.write("bad.toml", "x = 1");
  folder.write("text.txt", "hello");
  for (const Words& words : std::vector<Words>{{"print", path("none.toml")},
                                               {"print", path("none.stl")},
                                               {"print", path("bad.toml")},
                                               {"dry-run", path("none.svg")},
                                               {"dry-run", path("bad.toml"), "--personality", "klipper"},
                                               {"plan", path("bad.toml"), "-o", path("o"), "--layers", "x"},
                                               {"curve", path("none.svg"), "-o", path("o.svg")},
                                               {"inspect", path("none.3mf")},
                                               {"inspect", path("text.txt")},
                                               {"new", path("none.stl"), "-o", path("o")},
                                               {"resume", "nothing", "--spool", path("spool")},
                                               {"doctor", "--profile", path("none.toml")},
                                               {"simulate", "--personality", "klipper"},
                                               {"simulate", "--fault", "nonsense"},
                                               {"simulate", "--usb", "none-such"},
                                               {"simulate", "--bed", "1"},
                                               {"simulate", "--link", path("none/link")},
                                               {"setup", "--port", path("none"), "-o", path("o.toml")},
                                               {"status", "--state", path("state")},
                                               {"queue", "--state", path("state")},
                                               {"status", "--daemon", "http://127.0.0.1:1", "--token", "x"},
                                               {"serve", "--listen", "nonsense"},
                                               {"set", "--state", path("state")},
                                               {"start", "one"}})
    check_one_hint(words);
}

TEST_CASE("a missing model is missed before its printer") {
  const std::string sentence = said({"print", "/none/plate.stl"});
  CHECK(sentence.find("does not exist") != std::string::npos);
}

TEST_CASE("a simulator names the link that it cannot make") {
  const test::TempFolder folder;
  const std::string link = (folder / "none/link").string();
  CHECK(said({"simulate", "--link", link}).starts_with(link + ": "));
}

TEST_CASE("a port that does not exist is asked once, and its own hint is the only one") {
  const test::TempFolder folder;
  const Outcome outcome = run({"setup", "--port", (folder / "none").string()});
  CHECK(outcome.code == 2);
  CHECK(count(outcome.out, "asking the printer") == 1);
  CHECK(count(outcome.out + outcome.err, "this port does not exist") == 1);
  CHECK(outcome.err.find("does not answer") == std::string::npos);
}

TEST_CASE("a list of no prints says so") {
  const test::TempFolder folder;
  const Outcome outcome = run({"resume", "--list", "--spool", (folder / "none").string()});
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "no prints are kept in " + (folder / "none").string() + "\n");
}

TEST_CASE(
    "mistakes and missing files are said in one row of their own in windows of 60, 80 and 120 columns") {
  const int width = GENERATE(60, 80, 120);
  for (const auto& [words, row] : std::vector<std::pair<Words, std::string>>{
           {{"prnt"}, "unicursal: \"prnt\" is not a command; did"},
           {{"print", "--prt"}, "unicursal: print: \"--prt\" is not an option; did"},
           {{"print", "/none.toml"}, "unicursal: /none.toml: does not exist; check the"}}) {
    test::Terminal terminal(words, "/nonexistent", {static_cast<unsigned short>(width)});
    CHECK(terminal.wait() == 2);
    CHECK(terminal.screen().rows().size() <= (width == 60 ? 3 : 2));
    CHECK(terminal.screen().rows().front().starts_with(row));
  }
}
