// The README's commands run, its job is the example's, and the commands that its text names exist.
#include <poll.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <regex>
#include <sstream>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

namespace fs = std::filesystem;

const fs::path root = test::source_folder();
constexpr std::size_t most_bytes = 9000;
constexpr const char* port_in_readme = "/dev/ttyUSB0";

std::string readme() {
  return test::read_text(root / "README.md");
}

/// The blocks of the README in this language, without their fences.
std::vector<std::string> blocks(const std::string& language) {
  std::vector<std::string> found;
  std::istringstream lines(readme());
  bool inside = false, wanted = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      wanted = inside && line == "```" + language;
      if (wanted) found.emplace_back();
    } else if (wanted) {
      found.back() += line + "\n";
    }
  }
  return found;
}

std::vector<std::string> commands() {
  std::vector<std::string> found;
  for (const std::string& block : blocks("sh")) {
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) {
      line = line.substr(0, line.find(" #"));
      line.erase(line.find_last_not_of(' ') + 1);
      if (!line.empty()) found.push_back(line);
    }
  }
  return found;
}

/// A folder with the examples, a simulated printer, and a home for prints and daemons.
class Desk {
 public:
  Desk() {
    for (const auto& file : fs::directory_iterator(root / "host/examples"))
      fs::copy(file.path(), folder_ / file.path().filename().string());
    // Slow enough that a print of the daemon is still heating when it is cancelled.
    printer_ = std::make_unique<test::Child>(
        std::vector<std::string>{"simulate", "--profile", path("diamond.toml"), "--link", path("printer"),
                                 "--speed", "100", "--report", path("seen.json")});
    folder_.write("answers", "31\n45\n73\ny\n");  // to `unicursal tune`
    REQUIRE(wait_for([&] { return fs::exists(folder_ / "printer"); }));
  }

  std::string path(const std::string& name) const { return folder_ / name; }

  /// Runs the command in the folder. Returns its exit code; output goes to the file "output".
  int run(const std::string& command) const {
    const int status = std::system((in_folder("timeout 250", command) + " < answers > output 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string output() const { return test::read_text(folder_ / "output"); }

  /// Starts the daemon, which stays, on any free address.
  void serve(const std::string& command) {
    const std::string line = "(" + in_folder("exec", command) +
                             " --listen 127.0.0.1:0 > served 2>&1) & echo $! > \"" + path("daemon") + "\"";
    REQUIRE(std::system(line.c_str()) == 0);
    daemon_ = std::stoi(test::read_text(folder_ / "daemon"));
    INFO(test::read_text(folder_ / "served"));
    REQUIRE(wait_for([&] { return test::read_text(folder_ / "served").find("listening") == 0; }));
  }
  ~Desk() {
    if (daemon_ > 0) kill(daemon_, SIGKILL);
  }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

 private:
  /// The shell's text for a command of the program, started by `starter`.
  std::string in_folder(const std::string& starter, const std::string& command) const {
    return "cd \"" + folder_.path().string() + "\" && export XDG_STATE_HOME=\"$PWD/state\" && " + starter +
           " \"" + test::program() + "\"" + command.substr(std::string("unicursal").size());
  }
  template <class Condition>
  static bool wait_for(const Condition& condition) {
    for (int i = 0; i < 2400 && !condition(); ++i) poll(nullptr, 0, 50);
    return condition();
  }

  test::TempFolder folder_;
  std::unique_ptr<test::Child> printer_;
  pid_t daemon_ = -1;
};

void check_script(const std::string& script) {
  INFO(script);
  REQUIRE(fs::exists(root / script));
  CHECK((fs::status(root / script).permissions() & fs::perms::owner_exec) != fs::perms::none);
  CHECK(std::system(("bash -n \"" + (root / script).string() + "\"").c_str()) == 0);
}

void check_command(Desk& desk, std::string command) {
  INFO(command);
  if (command.starts_with("host/") || command.starts_with("tests/")) return check_script(command);
  if (command.starts_with("cd ")) {
    CHECK(fs::is_directory(root / command.substr(3)));
    return;
  }
  if (command == "export PATH=$PWD/build/program/host:$PATH") return;
  REQUIRE(command.starts_with("unicursal "));
  if (const std::size_t at = command.find(port_in_readme); at != std::string::npos)
    command.replace(at, std::string(port_in_readme).size(), desk.path("printer"));
  if (command.starts_with("unicursal serve ")) return desk.serve(command);
  const int code = desk.run(command);
  INFO(desk.output());
  CHECK(code == 0);
}

}  // namespace

TEST_CASE("The README is short, and its job is the example") {
  CHECK(readme().size() <= most_bytes);
  const auto files = blocks("toml");
  REQUIRE(files.size() == 2);
  CHECK(files[0] == test::read_text(root / "host/examples/leaf.toml"));
  const test::TempFolder folder;
  const std::string profile = folder.write("mine.toml", files[1]).string();
  const test::Outcome outcome = test::run({"plan", (root / "host/examples/leaf.toml").string(), "--profile",
                                           profile, "--layers", "0:0", "-o", "/dev/null"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
}

TEST_CASE("The README's commands run", "[optimised]") {
  Desk desk;
  const auto all = commands();
  CHECK(all.size() > 15);
  for (const std::string& command : all) check_command(desk, command);
}

TEST_CASE("The README's text names commands that exist") {
  static const std::regex span("`unicursal ([a-z-]+( transition| colours| flow)?)( [^`]*|)`");
  const std::string text = readme();
  std::size_t count = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), span), end; i != end; ++i, ++count) {
    std::istringstream words((*i)[1]);
    std::vector<std::string> command;
    for (std::string word; words >> word;) command.push_back(word);
    command.emplace_back("--help");
    INFO((*i)[0]);
    CHECK(test::run(command).code == 0);
  }
  CHECK(count > 0);
}

}  // namespace unicursal
