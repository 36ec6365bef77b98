#include "host/cli/completing.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "host/cli/for_terminal.hpp"
#include "host/job/frames.hpp"
#include "host/link/link.hpp"
#include "host/spool/spool.hpp"
#include "sim/simulator.hpp"

namespace unicursal::host {
namespace {

using Offers = std::vector<Completion::Offer>;

const std::vector<std::string> profile_endings{".toml"};
const std::vector<std::string> model_endings{".svg",   ".stl", ".3mf", ".obj", ".amf",
                                             ".gcode", ".gco", ".gc",  ".g"};
const std::vector<std::string> job_endings{".toml", ".svg",   ".stl", ".3mf", ".obj",
                                           ".amf",  ".gcode", ".gco", ".gc",  ".g"};

Offers words_of(const std::vector<std::string>& words) {
  Offers offers;
  for (const std::string& word : words) offers.push_back({word, ""});
  return offers;
}

Offers port_offers() {
  Offers offers{{"auto", "search for the printer"}};
  for (const PortInfo& port : list_ports()) offers.push_back({port.path, port.description});
  return offers;
}

Offers frame_offers() {
  Offers offers;
  for (const ShippedFrame& frame : frames()) offers.push_back({std::string(frame.name), ""});
  return offers;
}

/// Each line of the help is "  KIND:VALUE   what it does". The value is the user's.
Offers fault_offers() {
  Offers offers;
  std::istringstream lines(sim::fault_help());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' '), end = line.find_first_of(" :", begin);
    const std::size_t text = line.find_first_not_of(' ', line.find(' ', begin));
    if (begin == std::string::npos || end == std::string::npos) continue;
    const bool has_value = line[end] == ':';
    offers.push_back({line.substr(begin, end - begin + (has_value ? 1 : 0)),
                      text == std::string::npos ? "" : line.substr(text)});
  }
  return offers;
}

Offers print_offers() {
  Offers offers;
  for (const auto& folder : kept_prints(default_spool_root()))
    offers.push_back({folder.filename().string(), ""});
  return offers;
}

Completion only(Offers offers) {
  return {std::move(offers), WantedFiles::none, {}};
}
Completion files(std::vector<std::string> endings) {
  return {{}, WantedFiles::some, std::move(endings)};
}

using Values = Completion (*)();
Completion free_value() {
  return {};
}
Completion any_file() {
  return {{}, WantedFiles::all, {}};
}
Completion folder() {
  return {{}, WantedFiles::folders, {}};
}

/// The values of a placeholder.
const std::map<std::string, Values>& placeholders() {
  static const std::map<std::string, Values> all{
      {"JOB", [] { return files(job_endings); }},
      {"PROFILE", [] { return files(profile_endings); }},
      {"MODEL", [] { return files(model_endings); }},
      {"FILE", any_file},
      {"PATH", any_file},
      {"DIR", folder},
      {"PORT",
       [] {
         return Completion{port_offers(), WantedFiles::all, {}};
       }},
      {"FIRMWARE", [] { return only(words_of(sim::personality_names())); }},
      {"FRAME", [] { return only(frame_offers()); }},
      {"FAULT", [] { return only(fault_offers()); }},
      {"SHELL",
       [] {
         return only(words_of({"bash", "zsh", "fish"}));
       }},
      {"PRINT", [] { return only(print_offers()); }},
      {"NUMBER", free_value},
      {"N", free_value},
      {"K", free_value},
      {"A:B", free_value},
      {"FACTOR", free_value},
      {"RATE", free_value},
      {"SECONDS", free_value},
      {"S", free_value},
      {"MB", free_value},
      {"MM", free_value},
      {"MM,...", free_value},
      {"MM3", free_value},
      {"NUMBERS", free_value},
      {"FEEDER", free_value},
      {"TICK", free_value},
      {"PERCENT", free_value},
      {"CELSIUS", free_value},
      {"COLOUR", free_value},
      {"URL", free_value},
      {"TEXT", free_value},
      {"ADDRESS", free_value},
      {"HOST", free_value},
      {"NAME", free_value},
      {"COMMAND", free_value},
  };
  return all;
}

std::string placeholder_of(const CLI::Option& option) {
  return option.get_positional() ? option.get_name(true) : option.get_option_text();
}

Completion values_of(const CLI::Option& option) {
  const std::string placeholder = placeholder_of(option);
  if (placeholder.find('|') != std::string::npos) return only(words_of(CLI::detail::split(placeholder, '|')));
  const auto known = placeholders().find(placeholder);
  return known == placeholders().end() ? Completion{} : known->second();
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

std::string first_sentence(const std::string& text) {
  return text.substr(0, text.find(". "));
}

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  const auto found =
      app.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

Offers command_offers(const CLI::App& app) {
  Offers offers;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) offers.push_back({command->get_name(), command->get_description()});
  }
  return offers;
}

/// What the words before the unfinished one have led to.
class Reader {
 public:
  explicit Reader(const CLI::App& program) : app_(&program) {}

  void take(const std::string& word) {
    if (wants_value_) {
      wants_value_ = nullptr;
    } else if (word.starts_with('-') && !only_arguments_) {
      take_option(word);
    } else if (const CLI::App* command = command_named(*app_, word)) {
      app_ = command;
      given_.clear();
    } else {
      ++arguments_;
    }
  }

  Completion completion(const std::string& word) const {
    if (wants_value_) return values_of(*wants_value_);
    const std::size_t equals = word.find('=');
    if (word.starts_with("--") && equals != std::string::npos) {
      const CLI::Option* option = app_->get_option_no_throw(word.substr(0, equals));
      if (!option || !takes_value(*option)) return {};
      Completion completion = values_of(*option);
      for (Completion::Offer& offer : completion.offers) offer.word.insert(0, word.substr(0, equals + 1));
      return completion;
    }
    if (word.starts_with('-') && !only_arguments_) return only(option_offers());
    Offers commands = command_offers(*app_);
    if (!commands.empty()) return only(std::move(commands));
    if (const CLI::Option* argument = next_argument()) return values_of(*argument);
    return only(option_offers());
  }

 private:
  void take_option(const std::string& word) {
    only_arguments_ = word == "--";
    const CLI::Option* option = app_->get_option_no_throw(word.substr(0, word.find('=')));
    if (!option) return;
    given_.insert(option);
    if (takes_value(*option) && word.find('=') == std::string::npos) wants_value_ = option;
  }

  const CLI::Option* next_argument() const {
    std::size_t left = arguments_;
    for (const CLI::Option* option : app_->get_options()) {
      if (!option->get_positional()) continue;
      const auto most = static_cast<std::size_t>(option->get_items_expected_max());
      if (left < most) return option;
      left -= most;
    }
    return nullptr;
  }

  /// Those that may still be given, by their long names.
  Offers option_offers() const {
    Offers offers;
    for (const CLI::Option* option : app_->get_options()) {
      if (option->get_lnames().empty()) continue;
      const bool repeated = option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
      if (repeated || given_.count(option) == 0)
        offers.push_back({"--" + option->get_lnames().front(), option->get_description()});
    }
    return offers;
  }

  const CLI::App* app_;
  const CLI::Option* wants_value_ = nullptr;
  std::set<const CLI::Option*> given_;
  std::size_t arguments_ = 0;
  bool only_arguments_ = false;  ///< after "--"
};

}  // namespace

Completion completion_of(const CLI::App& program, const std::vector<std::string>& words) {
  const std::string unfinished = words.empty() ? "" : words.back();
  Reader reader(program);
  for (std::size_t i = 0; i + 1 < words.size(); ++i) reader.take(words[i]);
  Completion completion = reader.completion(unfinished);
  std::erase_if(completion.offers,
                [&](const Completion::Offer& offer) { return !offer.word.starts_with(unfinished); });
  return completion;
}

std::string answer_of(const Completion& completion) {
  std::string answer;
  switch (completion.files) {
    case WantedFiles::none:
      answer = "words";
      break;
    case WantedFiles::folders:
      answer = "folders";
      break;
    case WantedFiles::some:
    case WantedFiles::all:
      answer = "files";
      for (const std::string& ending : completion.endings) answer += ' ' + ending;
      break;
  }
  answer += '\n';
  for (const Completion::Offer& offer : completion.offers) {
    std::string description = first_sentence(offer.description);
    std::replace_if(
        description.begin(), description.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    answer += offer.word + '\t' + description + '\n';
  }
  return answer;
}

bool is_known_placeholder(const std::string& placeholder) {
  return placeholder.find('|') != std::string::npos || placeholders().count(placeholder) > 0;
}

}  // namespace unicursal::host
