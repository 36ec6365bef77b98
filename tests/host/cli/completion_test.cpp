// What Tab offers: asked of the program itself, and in real shells.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <optional>
#include <regex>
#include <sstream>

#include "host/cli/completing.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// The answer for a command line that ends in the last word.
std::string answer(std::vector<std::string> words) {
  words.insert(words.begin(), "complete");
  const test::Outcome outcome = test::run(words);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  return outcome.out;
}

/// The offered words, each with a blank before and after it.
std::string offers(const std::vector<std::string>& words) {
  std::istringstream lines(answer(words));
  std::string line, result = " ";
  std::getline(lines, line);
  CHECK_THAT(line, StartsWith("words"));
  while (std::getline(lines, line)) result += line.substr(0, line.find('\t')) + ' ';
  return result;
}

/// A shell in a terminal, with the script that the program writes for it. Ctrl-T writes its command line to a
/// file.
class Shell {
 public:
  explicit Shell(const std::string& name) : line_file_((folder_ / "line").string()) {
    for (const char* file : {"leaf.toml", "part.3mf", "pasta.txt", "two words.svg"}) folder_.write(file, "");
    std::filesystem::create_directory(folder_ / "pictures");
    const test::Outcome script = test::run({"completion", name});
    REQUIRE(script.code == 0);
    const std::string program_folder = std::filesystem::path(test::program()).parent_path().string();
    const std::string common = "cd '" + folder_.path().string() + "'\n";
    std::vector<std::string> arguments;
    if (name == "bash") {
      arguments = {"--noprofile", "--rcfile", (folder_ / "rc").string(), "-i"};
      folder_.write("rc", common + script.out +
                              "PS1='READY>'; bind -x '\"\\C-t\": printf %s \"$READLINE_LINE\" > " +
                              line_file_ + "; echo WRITTEN'\n");
    } else if (name == "zsh") {
      arguments = {"-i"};
      folder_.write(".zshrc", common + "autoload -U compinit; compinit -u -D\n" + script.out +
                                  "PS1='READY>'; write() { print -rn -- $BUFFER > " + line_file_ +
                                  "; print WRITTEN; }; zle -N write; bindkey '^T' write\n");
    } else {
      arguments = {"-C", "source " + (folder_ / "rc").string()};
      folder_.write("rc", common + script.out + "function fish_prompt; echo 'READY>'; end\n" +
                              "bind \\ct 'commandline > " + line_file_ + "; echo WRITTEN'\n");
    }
    const std::map<std::string, std::string> environment{{"PATH", program_folder + ":" + std::getenv("PATH")},
                                                         {"HOME", folder_.path().string()},
                                                         {"ZDOTDIR", folder_.path().string()},
                                                         {"TERM", "xterm"}};
    terminal_.emplace(arguments, "/nonexistent", test::TerminalKind{200, environment, name});
    terminal_->await("READY>");
  }

  /// What the command line has become when this was typed and Tab was pressed.
  std::string completed(const std::string& typed) {
    terminal_->type("\x15" + typed + "\t\x14");  // Ctrl-U clears the line
    terminal_->await("WRITTEN");
    std::string line = test::read_text(line_file_);
    line.erase(line.find_last_not_of(" \n") + 1);
    return line;
  }

 private:
  test::TempFolder folder_;
  std::string line_file_;
  std::optional<test::Terminal> terminal_;
};

}  // namespace

TEST_CASE("the program knows what can stand next on its command line") {
  CHECK_THAT(answer({""}),
             Contains("dry-run\tPrint a job on a simulated printer and show what would come out.\n") &&
                 Contains("\ncompletion\t") && !Contains("check-job"));
  CHECK(offers({"st"}) == " start status stop ");
  CHECK(offers({"--ve"}) == " --version ");
  CHECK(offers({"dry-run", "--lay"}) == " --layers ");
  CHECK(offers({"dry-run", "leaf.toml", "--charge"}) == " --charge-planning ");
  CHECK(offers({"tune", ""}) == " transition colours flow ");
  CHECK(offers({"tune", "transition", "--sto"}) == " --stopped ");
  CHECK(offers({"status", ""}) == " --help --daemon --token --state --json ");  // nothing else can follow
  CHECK(offers({"wrong", ""}).find(" dry-run ") != std::string::npos);
}

TEST_CASE("Tab offers an option once, unless it may be repeated") {
  CHECK(offers({"dry-run", "--threads", "2", "--thr"}) == " ");
  CHECK(offers({"dry-run", "--threads=2", "--thr"}) == " ");
  CHECK(offers({"dry-run", "--fault", "stall:5", "--fau"}) == " --fault --faults ");
  CHECK(offers({"plan", "-o", "leaf.gcode", "--out"}) == " ");
}

TEST_CASE("Tab offers the values of an option") {
  CHECK(offers({"dry-run", "--personality", "mar"}) ==
        " marlin marlin-8bit marlin-advanced-ok marlin-host marlin-few-tools marlin-plain ");
  CHECK(offers({"simulate", "--personality=rep"}) ==
        " --personality=repetier --personality=repetier-0.92 --personality=reprapfirmware ");
  CHECK(offers({"simulate", "--usb", ""}) == " none cdc ftdi ");
  CHECK(offers({"curve", "leaf.toml", "--preset", ""}) == " best paper ");
  CHECK(offers({"print", "--pause-heat", "l"}) == " lower ");
  CHECK(offers({"setup", "--frame", "geeetech-a1"}) == " geeetech-a10m geeetech-a10t ");
  CHECK(offers({"dry-run", "--fault", "bit"}) == " bitflip: ");
  CHECK(offers({"completion", ""}) == " bash zsh fish ");
  CHECK(offers({"plan", "--layers", ""}) == " ");  // numbers cannot be guessed
  CHECK_THAT(answer({"print", "--port", ""}), StartsWith("files\nauto\t"));
}

TEST_CASE("Tab offers files of the kind that an argument wants") {
  const std::string jobs = "files .toml .svg .stl .3mf .obj .amf .gcode .gco .gc .g\n";
  CHECK(answer({"dry-run", ""}) == jobs);
  CHECK(answer({"dry-run", "--layers", "0:0", ""}) == jobs);
  CHECK(answer({"print", "--", ""}) == jobs);
  CHECK(answer({"queue", "--upload", ""}) == jobs);
  CHECK(answer({"new", "a.stl", "b.stl", ""}) == "files .svg .stl .3mf .obj .amf .gcode .gco .gc .g\n");
  CHECK(answer({"tune", "transition", ""}) == "files .toml\n");
  CHECK(answer({"dry-run", "--profile", ""}) == "files .toml\n");
  CHECK(answer({"dry-run", "--report="}) == "files\n");
  CHECK(answer({"dry-run", "--picture", ""}) == "folders\n");
  CHECK_THAT(answer({"dry-run", "leaf.toml", ""}), StartsWith("words\n--help\t"));  // there is only one job
}

TEST_CASE("any words can be asked about") {
  CHECK_THAT(answer({}), Contains("\ndry-run\t"));
  CHECK(offers({"\xff\x1b[2J"}) == " ");
  CHECK(offers({"dry-run", "--no-such-option", "--no-such=", "-", "--lay"}) == " --layers ");
  CHECK(offers({"dry-run", "=", "--=", ""}) != "");
}

TEST_CASE("each placeholder in the help is one whose values Tab knows") {
  std::vector<std::vector<std::string>> commands{
      {"tune", "transition"}, {"tune", "colours"}, {"tune", "flow"}};
  std::istringstream names(offers({""}));
  for (std::string name; names >> name;) commands.push_back({name});
  CHECK(commands.size() > 20);
  const std::regex option(R"(^  (?:-\w,)?--[a-z-]+ (\S+).*)"), argument("^  ([A-Z]+)( .*|)$");
  for (std::vector<std::string> command : commands) {
    command.emplace_back("--help");
    std::istringstream lines(test::run(command).out);
    std::smatch found;
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_match(line, found, option) && !std::regex_match(line, found, argument)) continue;
      if (line.starts_with("  --") && line.find("  ", 3) < line.find(found[1])) continue;  // a flag
      INFO(line);
      CHECK(host::is_known_placeholder(found[1]));
    }
  }
}

TEST_CASE("Tab completes commands, options, values, jobs and folders in bash, zsh and fish") {
  const std::string name = GENERATE(as<std::string>(), "bash", "zsh", "fish");
  if (std::system(("command -v " + name + " > /dev/null").c_str()) != 0) {
    WARN(name + " is not installed; host/install-packages --with-tests installs it");
    return;
  }
  INFO(name);
  Shell shell(name);
  CHECK(shell.completed("unicursal dry") == "unicursal dry-run");
  CHECK(shell.completed("unicursal dry-run --full") == "unicursal dry-run --full-quality");
  CHECK(shell.completed("unicursal dry-run --personality reprap") ==
        "unicursal dry-run --personality reprapfirmware");
  CHECK(shell.completed("unicursal dry-run --personality=reprap") ==
        "unicursal dry-run --personality=reprapfirmware");
  CHECK(shell.completed("unicursal dry-run lea") == "unicursal dry-run leaf.toml");
  CHECK(shell.completed("unicursal print pa") == "unicursal print part.3mf");  // not pasta.txt
  CHECK(shell.completed("unicursal plan leaf.toml --picture pi") ==
        "unicursal plan leaf.toml --picture pictures/");
  CHECK(shell.completed("unicursal plan leaf.toml --report pas") ==
        "unicursal plan leaf.toml --report pasta.txt");
  CHECK(shell.completed("unicursal dry-run --fault bit") == "unicursal dry-run --fault bitflip:");
}
