#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text/printable.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/report/history.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t widest_name = 60;  ///< characters on a terminal

std::string shown(const std::string& text) {
  return core::printable(text, widest_name);
}

/// A filament of all prints, with its currency: spools of one name, plastic and colour are one.
struct Spent {
  PastFilament filament;
  std::string currency;
  std::size_t prints = 0;
};

std::vector<Spent> spent(const std::vector<PastPrint>& prints) {
  std::vector<Spent> all;
  for (const PastPrint& print : prints) {
    for (const PastFilament& one : print.filaments) {
      auto same = std::find_if(all.begin(), all.end(), [&](const Spent& other) {
        return other.filament.name == one.name && other.filament.material == one.material &&
               other.filament.colour == one.colour && other.currency == print.currency;
      });
      if (same == all.end()) {
        same = all.insert(all.end(), {{one.name, one.material, one.colour, {}}, print.currency});
        same->filament.amount.cost = 0.0;
      }
      add(same->filament.amount, one.amount);
      ++same->prints;
    }
  }
  return all;
}

nlohmann::json json_of(const PastFilament& filament) {
  nlohmann::json json = to_json(filament.amount);
  json["name"] = filament.name;
  json["material"] = filament.material;
  json["colour"] = filament.colour;
  return json;
}

void show_all_json(const std::vector<PastPrint>& prints) {
  nlohmann::json list = nlohmann::json::array(), filaments = nlohmann::json::array();
  for (const PastPrint& print : prints) {
    nlohmann::json of_print = nlohmann::json::array();
    for (const PastFilament& filament : print.filaments) of_print.push_back(json_of(filament));
    list.push_back({{"print", print.name},
                    {"ended", print.ended},
                    {"currency", print.currency},
                    {"filaments", of_print}});
  }
  for (const Spent& one : spent(prints)) {
    nlohmann::json json = json_of(one.filament);
    json["currency"] = one.currency;
    json["prints"] = one.prints;
    filaments.push_back(std::move(json));
  }
  show_json({{"prints", list}, {"filaments", filaments}});
}

class History final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "history", "Print",
                    "Show what past prints, and each filament, have taken in metres, grams and cost.",
                    "unicursal history");
    declare_spool(app, spool_);
    app.add_flag("--json", json_, "Write one JSON object to standard output.")->group("Output");
    return app;
  }

  Exit run() override {
    const std::vector<PastPrint> prints = history(spool_ ? *spool_ : default_spool_root());
    if (json_) {
      show_all_json(prints);
      return Exit::success;
    }
    if (prints.empty()) show(stdout, "no print has ended yet\n");
    for (const PastPrint& print : prints) {
      show(stdout, "{}  {}\n", shown(print.name), shown(print.ended));
      for (const PastFilament& one : print.filaments)
        show(stdout, "    {}: {}\n", shown(one.name), in_words(one.amount, print.currency));
    }
    if (!prints.empty()) show(stdout, "filaments:\n");
    for (const Spent& one : spent(prints))
      show(stdout, "    {} ({}, {}): {} in {} {}\n", shown(one.filament.name), shown(one.filament.material),
           shown(one.filament.colour), in_words(one.filament.amount, one.currency), one.prints,
           one.prints == 1 ? "print" : "prints");
    return Exit::success;
  }

 private:
  std::optional<std::filesystem::path> spool_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_history() {
  return std::make_unique<History>();
}

}  // namespace unicursal::host
