// The simulated printer with a host program that is not ours: printcore from Debian's package printrun. The
// test passes with a warning if it is not installed.
#include <poll.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sstream>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

constexpr const char* printcore = "/usr/bin/printcore";
constexpr std::size_t lines_to_print = 5000;

/// The first `most` commands of a G-code file, without comments.
std::vector<std::string> commands_of(const std::string& gcode, std::size_t most) {
  std::vector<std::string> commands;
  std::istringstream text(gcode);
  for (std::string line; commands.size() < most && std::getline(text, line);) {
    line = line.substr(0, line.find(';'));
    while (line.ends_with(' ')) line.pop_back();
    if (!line.empty()) commands.push_back(line);
  }
  return commands;
}

/// Runs printcore to its end. Returns its exit code, or 127 if it could not be started.
int print_file(const std::string& port, const std::string& file) {
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execl(printcore, printcore, "-b", "115200", port.c_str(), file.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("printcore prints a file that was planned: each command once, in order", "[optimised]") {
  if (!std::filesystem::exists(printcore)) {
    WARN("printcore is not installed");
    return;
  }
  test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  folder.write("plate.svg", test::sample_drawing);
  const std::string fine =
      test::replaced(test::replaced(test::sample_job, "bead_width = 1.0", "bead_width = 0.45"),
                     "height = 0.4", "height = 0.6");
  const std::string job = folder.write("job.toml", fine).string();
  REQUIRE(test::run({"plan", job, "-o", (folder / "all.gcode").string()}).code == 0);
  const auto commands = commands_of(test::read_text(folder / "all.gcode"), lines_to_print);
  REQUIRE(commands.size() == lines_to_print);
  std::string text;
  for (const std::string& command : commands) text += command + "\n";
  const std::string file = folder.write("part.gcode", text).string();

  const std::string link = (folder / "printer").string();
  test::Child simulator({"simulate", "--once", "--link", link, "--report", (folder / "seen.json").string(),
                         "--transcript", (folder / "executed").string()});
  while (!std::filesystem::exists(link)) {
    REQUIRE(simulator.running());
    poll(nullptr, 0, 5);
  }
  REQUIRE(print_file(link, file) == 0);
  REQUIRE(simulator.wait().code == 0);

  auto executed = commands_of(test::read_text(folder / "executed"), 2 * lines_to_print);
  std::erase_if(executed, [](const std::string& line) {
    return line == "M110" || line == "M105";
  });  // printcore adds these
  auto wanted = commands;
  std::erase(wanted, "M105");
  CHECK(executed == wanted);
  const auto seen = nlohmann::json::parse(test::read_text(folder / "seen.json"));
  CHECK(seen["lines"]["resends"] == 0);
  CHECK(seen["lines"]["lost_bytes"] == 0);
}

}  // namespace unicursal
