// The file of the history: two writers, damage, locks, full and foreign files.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/history/csv.hpp"
#include "host/history/history.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using namespace host;
using Kind = HistoryError::Kind;
constexpr std::chrono::milliseconds at_once{1};

PastPrint past_print(const std::string& name, double grams = 2) {
  PastPrint print;
  print.print = name;
  print.job = "leaf";
  print.ended = "completed";
  print.currency = "EUR";
  print.seconds = 100;
  print.filaments = {{1, "sea", "PLA", "#2660c4", {1, grams, 0.5}}, {2, "sun", "PLA", "#d63430", {2, 1, {}}}};
  return print;
}

std::vector<PastPrint> all_of(const test::TempFolder& folder) {
  return History(folder.path(), History::For::reading).list({}, 1000);
}

Kind kind_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const HistoryError& error) {
    CHECK_FALSE(error.remedy().empty());
    return error.kind();
  }
  FAIL("nothing was refused");
  return Kind::other;
}

}  // namespace

TEST_CASE("A history is read before anything was printed, and makes no file for that") {
  const test::TempFolder folder;
  CHECK(all_of(folder).empty());
  CHECK(History(folder.path(), History::For::reading).totals().prints == 0);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("Later sessions of a print change its row, and a print of the same name gets one of its own") {
  const test::TempFolder folder;
  History history(folder.path(), History::For::changing);
  PastPrint first = past_print("a");
  first.foretold = 300;
  first.warnings = {"it was late"};
  const auto id = history.add(first, "picture", false);
  REQUIRE(history.set_note(id, "mine"));
  PastPrint more = past_print("a", 5);
  more.foretold = 20;
  more.warnings = {"it was late", "it was cold"};
  CHECK(history.add(more, "", true) == id);
  const PastPrint whole = history.find(id).value();
  CHECK(whole.seconds == 200);
  CHECK(whole.foretold == 300);
  CHECK(whole.filaments.at(0).amount.grams == 5);
  CHECK(whole.warnings == std::vector<std::string>{"it was late", "it was cold"});
  CHECK(whole.note == "mine");
  CHECK(history.picture(id) == "picture");
  CHECK(history.add(past_print("a"), "", false) != id);
  const PastTotals totals = history.totals();
  CHECK(totals.prints == 2);
  REQUIRE(totals.filaments.size() == 2);
  CHECK(totals.filaments[0].filament.amount.grams == 7);
  CHECK(totals.filaments[0].filament.amount.cost == 1.0);
  CHECK_FALSE(totals.filaments[1].filament.amount.cost);
  CHECK(history.list(id + 1, 10).size() == 1);
}

TEST_CASE("Prints of older versions are taken over once, each as one row, and damaged lines are left out") {
  const test::TempFolder folder;
  const std::string sound =
      R"({"print":"2026-11-22-101500-a","ended":"stopped","currency":"EUR","filaments":[]})";
  std::string later = sound;
  later.replace(later.find("stopped"), 7, "completed");
  folder.write("history", sound + "\n{\"print\":3}\nrubbish\n" + std::string(300000, 'x') + "\n" + later +
                              "\n" + sound.substr(0, 20));
  CHECK(all_of(folder).size() == 1);
  const auto prints = all_of(folder);
  REQUIRE(prints.size() == 1);
  CHECK(prints[0].ended == "completed");
  CHECK(prints[0].began == 1795342500);
  CHECK(prints[0].job == "a");
  CHECK_FALSE(std::filesystem::exists(folder / "history"));
  CHECK(test::read_text(folder / "history.taken").find("rubbish") != std::string::npos);
}

TEST_CASE("Two processes write to one history at once, and no print is lost") {
  const test::TempFolder folder;
  constexpr int each = 15;
  std::vector<pid_t> writers;
  for (const char* name : {"a", "b", "c"}) {
    writers.push_back(fork());
    if (writers.back() != 0) continue;
    int left = each;
    try {
      for (; left > 0; --left)
        History(folder.path(), History::For::changing, std::chrono::seconds(60))
            .add(past_print(name), "x", false);
    } catch (...) {
    }
    _exit(left);
  }
  for (const pid_t writer : writers) {
    int status = 0;
    waitpid(writer, &status, 0);
    CHECK(status == 0);
  }
  CHECK(all_of(folder).size() == 3 * each);
}

TEST_CASE("A damaged history is set aside, and the next print begins another") {
  const test::TempFolder folder;
  const std::string rubbish(5000, 'r');
  folder.write("history.db", rubbish);
  History history(folder.path(), History::For::changing);
  REQUIRE(history.notes().size() == 1);
  CHECK(history.notes()[0].find("history.damaged") != std::string::npos);
  history.add(past_print("a"), "", false);
  CHECK(all_of(folder).size() == 1);
  CHECK(test::read_text(folder / "history.damaged") == rubbish);
}

TEST_CASE("Pages that are damaged in the middle are found while rows are read, and set aside as well") {
  const test::TempFolder folder;
  {
    History history(folder.path(), History::For::changing);
    for (int i = 0; i < 50; ++i)
      history.add(past_print("a" + std::to_string(i)), std::string(9000, 'p'), false);
  }
  {
    std::fstream file(folder / "history.db", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(4096);
    const std::string rubbish(200000, '\xff');
    file.write(rubbish.data(), static_cast<std::streamsize>(rubbish.size()));
  }
  History history(folder.path(), History::For::changing);
  history.add(past_print("after"), "", false);
  CHECK(history.list({}, 1000).size() == 1);
  CHECK(std::filesystem::file_size(folder / "history.damaged") > 200000);
}

TEST_CASE("A history that another program has locked is waited for, and the print waits in a file then") {
  const test::TempFolder folder;
  History(folder.path(), History::For::changing).add(past_print("a"), "", false);
  {
    Database other(folder / "history.db", Database::Access::change, at_once);
    Transaction holds(other);
    CHECK(all_of(folder).size() == 1);  // reading goes on
    CHECK(kind_of([&] {
            History(folder.path(), History::For::changing, at_once).add(past_print("b"), "", false);
          }) == Kind::busy);
    REQUIRE(History::let_wait(folder.path(), past_print("b"), false));
  }
  const auto prints = all_of(folder);
  REQUIRE(prints.size() == 2);
  CHECK(prints[0].print == "b");
  CHECK(prints[0].filaments.size() == 2);
  CHECK(prints[0].seconds == 100);
}

TEST_CASE("A print for which the disk has no room takes no other print with it") {
  const test::TempFolder folder;
  History(folder.path(), History::For::changing);
  REQUIRE(History::let_wait(folder.path(), past_print("a"), false));
  const std::string waiting = test::read_text(folder / "history");
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &usual) == 0);
  const rlimit full{waiting.size() + 10, usual.rlim_max};  // room for a part of a line
  REQUIRE(setrlimit(RLIMIT_FSIZE, &full) == 0);
  const bool kept = History::let_wait(folder.path(), past_print("b"), false);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &usual) == 0);
  std::signal(SIGXFSZ, former);
  CHECK_FALSE(kept);
  CHECK(test::read_text(folder / "history") == waiting);
  REQUIRE(History::let_wait(folder.path(), past_print("c"), false));
  const auto prints = all_of(folder);
  REQUIRE(prints.size() == 2);
  CHECK(prints[0].print == "c");
  CHECK(prints[1].print == "a");
}

TEST_CASE("A history of a later version and a foreign database are left alone") {
  const test::TempFolder folder;
  {
    Database foreign(folder / "history.db", Database::Access::change, at_once);
    foreign.run("CREATE TABLE bookmarks (url TEXT)");
  }
  CHECK(kind_of([&] { History(folder.path(), History::For::changing); }) == Kind::other);
  {
    Database later(folder / "history.db", Database::Access::change, at_once);
    later.run("PRAGMA user_version = 2");
  }
  CHECK(kind_of([&] { all_of(folder); }) == Kind::other);
  CHECK_FALSE(std::filesystem::exists(folder / "history.damaged"));
}

TEST_CASE("Hostile names survive the way into a table, and no cell is a formula") {
  const test::TempFolder folder;
  PastPrint print = past_print("2026-11-22-101500-\"><script>\xff");
  print.job = "=HYPERLINK(\"http://x\")";
  print.reason = "-1,5\r\n\"quoted\"";
  print.filaments[0].name = std::string("@sum\0(1)", 8);
  History history(folder.path(), History::For::changing);
  history.add(print, "", false);
  const PastPrint kept = history.list({}, 1).at(0);
  CHECK(kept.print == print.print);
  CHECK(kept.job == print.job);
  CHECK(kept.filaments[0].name == print.filaments[0].name);
  const std::string table = csv_of({kept});
  CHECK(table.find(",\"'=HYPERLINK(\"\"http://x\"\")\",") != std::string::npos);
  CHECK(table.find(",\"'-1,5\r\n\"\"quoted\"\"\",") != std::string::npos);
  CHECK(table.find(",'@sum(1),") != std::string::npos);
  CHECK_FALSE(to_json(kept).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).empty());
}

}  // namespace unicursal
