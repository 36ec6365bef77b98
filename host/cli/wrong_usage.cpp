#include "host/cli/wrong_usage.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "core/text/printable.hpp"
#include "host/job/nearest.hpp"

namespace unicursal::host {
namespace {

/// A misspelt command differs by at most this many letters from the one that was meant.
constexpr std::size_t most_misspelt_letters = 2;

bool every(const CLI::App* /*app*/) {
  return true;
}

/// "print", "tune transition"; empty for the program.
std::string name_of(const CLI::App& app) {
  std::string words;
  for (const CLI::App* one = &app; one->get_parent() != nullptr; one = one->get_parent())
    words = one->get_name() + (words.empty() ? "" : " ") + words;
  return words;
}

std::string see_help(const CLI::App& app, const char* what) {
  const std::string name = name_of(app);
  return fmt::format("{}`unicursal{}{} --help`{}", *what == 0 ? "see " : "", name.empty() ? "" : " ", name,
                     what);
}

std::string did_you_mean(const std::string& word) {
  return "did you mean \"" + word + "\"?";
}

std::string in_quotes(const std::string& word) {
  return '"' + core::printable(word) + '"';
}

[[noreturn]] void refuse_command(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const CLI::App* known : app.get_subcommands(every)) {
    if (!known->get_group().empty()) names.push_back(known->get_name());  // others are not listed
  }
  const std::string meant = nearest(given, names);
  const bool near = edit_distance(given, meant) <= most_misspelt_letters;
  throw core::DataError("", name_of(app), in_quotes(given) + " is not a command",
                        near ? did_you_mean(meant) : see_help(app, " lists the commands"));
}

std::vector<std::string> long_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The option that a person may have meant: a longer name, or a misspelt one; empty if none is like it.
std::string meant_option(const CLI::App& app, const std::string& given) {
  const std::vector<std::string> names = long_options(app);
  std::vector<std::string> longer;
  std::copy_if(names.begin(), names.end(), std::back_inserter(longer),
               [&](const std::string& name) { return given.size() > 3 && name.starts_with(given); });
  return longer.size() == 1 ? longer.front() : meant_by(given, names);
}

[[noreturn]] void refuse_option(const CLI::App& app, const std::string& given) {
  const std::string meant = meant_option(app, given);
  throw core::DataError("", name_of(app), in_quotes(given) + " is not an option",
                        meant.empty() ? see_help(app, " lists the options") : did_you_mean(meant));
}

/// "speed 80" where "--speed 80" was meant.
[[noreturn]] void refuse_word(const CLI::App& app, const std::string& given) {
  const std::vector<std::string> names = long_options(app);
  const bool option = std::find(names.begin(), names.end(), "--" + given) != names.end();
  throw core::DataError("", name_of(app), "the word " + in_quotes(given) + " is not expected here",
                        option ? did_you_mean("--" + given) : see_help(app, ""));
}

/// The greatest number of words that are neither options nor their values.
std::size_t most_arguments(const CLI::App& app) {
  std::size_t sum = 0;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional())
      sum += static_cast<std::size_t>(std::max(option->get_items_expected_max(), 1));
  }
  return sum;
}

bool is_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) == 0 &&
         word[1] != '.';
}

/// Returns how many further words the option takes.
std::size_t check_option(const CLI::App& app, const std::string& word) {
  const bool is_long = word.starts_with("--");
  const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
  const CLI::Option* option = app.get_option_no_throw(name);
  if (option == nullptr) refuse_option(app, is_long ? name : word);
  const bool has_value = word.size() > name.size();
  return has_value ? 0 : static_cast<std::size_t>(std::max(option->get_items_expected_min(), 0));
}

void replace(std::string& text, std::string_view what, std::string_view by) {
  if (const auto at = text.find(what); at != std::string::npos) text.replace(at, what.size(), by);
}

}  // namespace

void check_words(const CLI::App& program, int argc, const char* const* argv) {
  const CLI::App* app = &program;
  std::size_t arguments = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") return;
    if (is_option(word)) {
      i += static_cast<int>(check_option(*app, word));
      continue;
    }
    if (app->get_subcommands(every).empty()) {
      if (++arguments > most_arguments(*app)) refuse_word(*app, word);
      continue;
    }
    const auto known = app->get_subcommands(every);
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const CLI::App* one) { return one->get_name() == word; });
    if (found == known.end()) refuse_command(*app, word);
    app = *found;
  }
}

core::DataError usage_error(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  std::string text = error.what();
  const auto required = text.find(" required "), missing = text.find(" missing");
  if (text == "A subcommand is required") {
    text = "a command is missing";
  } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    replace(text, " is required", " is missing");
  } else if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
    replace(text, " excludes ", " cannot be given together with ");
  } else if (missing != std::string::npos && required < missing) {
    text = text.substr(0, text.find(':')) + ": its value is missing";
  }
  const char* const lists = text == "a command is missing" ? " lists the commands" : "";
  return {"", name_of(*app), text, see_help(*app, lists)};
}

}  // namespace unicursal::host
