// unicursal(1) describes the commands and options that the program has, and no others.
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/host/support/child_process.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

using Names = std::set<std::string>;

const std::filesystem::path man_page = test::source_folder() / "host/packaging/unicursal.1";

/// What the manual says about the options of one command, without their dashes' first one.
struct Section {
  Names mentioned;  ///< anywhere in the section
  Names described;  ///< as the head of a list item
};

/// The sections of the manual by their heading; subsections are sections of their own.
std::map<std::string, Section> sections_of_manual() {
  static const std::regex flag("Fl (-?[A-Za-z][A-Za-z-]*)");
  std::map<std::string, Section> sections;
  Section* current = nullptr;
  std::istringstream lines(test::read_text(man_page));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(".Sh ") || line.starts_with(".Ss ")) current = &sections[line.substr(4)];
    if (!current || !line.starts_with(".")) continue;
    for (std::sregex_iterator i(line.begin(), line.end(), flag), end; i != end; ++i) {
      current->mentioned.insert((*i)[1]);
      if (line.starts_with(".It ")) current->described.insert((*i)[1]);
    }
  }
  return sections;
}

Names commands_in_help() {
  static const std::regex command("^  ([a-z][a-z-]*)( .*|)$");
  Names names;
  std::istringstream lines(test::run({"--help"}).out);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, command)) names.insert(match[1]);
  }
  return names;
}

Names options_in_help(std::vector<std::string> command) {
  static const std::regex option("-(-?[A-Za-z][A-Za-z-]*)");
  command.emplace_back("--help");
  Names names;
  std::istringstream lines(test::run(command).out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  -")) continue;
    const std::string head = line.substr(2, line.find(' ', 2) - 2);  // "-o,--output"
    for (std::sregex_iterator i(head.begin(), head.end(), option), end; i != end; ++i) names.insert((*i)[1]);
  }
  names.erase("h");
  names.erase("-help");
  return names;
}

}  // namespace

TEST_CASE("The manual has every command with its options, and no other") {
  const auto sections = sections_of_manual();
  const Names shared = sections.at("SHARED OPTIONS").described;
  const Names commands = commands_in_help();
  CHECK(commands.size() >= 21);
  Names unused = shared;
  std::vector<std::vector<std::string>> all{{"tune", "transition"}, {"tune", "colours"}, {"tune", "flow"}};
  for (const std::string& command : commands) {
    if (command != "tune") all.push_back({command});
  }
  for (const std::vector<std::string>& command : all) {
    const std::string heading = command.size() > 1 ? command[0] + " " + command[1] : command[0];
    INFO(heading);
    REQUIRE(sections.count(heading) == 1);
    const Section& section = sections.at(heading);
    const Names options = options_in_help(command);
    CHECK(section.mentioned == options);
    for (const std::string& option : options) {
      INFO("-" << option);
      CHECK(section.described.count(option) + shared.count(option) > 0);
      if (section.described.count(option) == 0) unused.erase(option);
    }
  }
  CHECK(unused == Names{"h", "-help"});
}

}  // namespace unicursal
