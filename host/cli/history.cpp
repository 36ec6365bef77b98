#include "host/history/history.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text/printable.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/history/csv.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t widest_name = 60;  ///< characters on a terminal
constexpr std::size_t widest_note = 400;
constexpr std::size_t all_prints = 1'000'000'000;

std::string shown(const std::string& text, std::size_t widest = widest_name) {
  return core::printable(text, widest);
}

void show_print(const PastPrint& print) {
  show(stdout, "{}  {}  (number {})\n", shown(print.print), shown(print.ended), print.id);
  for (const PastFilament& one : print.filaments)
    show(stdout, "    {}: {}\n", shown(one.name), in_words(one.amount, print.currency));
  if (!print.note.empty()) show(stdout, "    note: {}\n", shown(print.note, widest_note));
}

void show_totals(const PastTotals& totals) {
  if (totals.prints > 0) show(stdout, "filaments:\n");
  for (const SpentFilament& one : totals.filaments)
    show(stdout, "    {} ({}, {}): {} in {} {}\n", shown(one.filament.name), shown(one.filament.material),
         shown(one.filament.colour), in_words(one.filament.amount, one.currency), one.prints,
         one.prints == 1 ? "print" : "prints");
}

class HistoryCommand final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "history", "Print",
                    "Show what past prints, and each filament, have taken in metres, grams and cost.",
                    "unicursal history");
    add_value(app, "NUMBER", number_, " ", "Show only the print of this number.")
        .check(integer_between(1, most_number));
    add_value(app, "--note", note_, "TEXT", "Give the print NUMBER this note instead of its own.");
    add_value(app, "--remove", remove_, "NUMBER", "Remove the print of this number from the history.")
        .check(integer_between(1, most_number));
    declare_spool(app, spool_);
    app.add_flag("--json", json_, "Write one JSON object to standard output.")->group("Output");
    app.add_flag("--csv", csv_,
                 "Write a table for spreadsheets (CSV) to standard output: a line for each filament of "
                 "each print.")
        ->group("Output");
    add_note(app, "Prints stay in the history until --remove removes them.");
    return app;
  }

  Exit run() override {
    if (note_ && !number_)
      throw core::DataError("", "--note", "is for one print",
                            "name its number, as `unicursal history` shows it");
    if (csv_ && json_)
      throw core::DataError("", "--csv", "cannot be written together with --json", "leave one of them out");
    History history(spool_ ? *spool_ : default_spool_root(),
                    note_ || remove_ ? History::For::changing : History::For::reading);
    for (const std::string& note : history.notes()) show(stderr, "note: {}\n", note);
    if (remove_) return changed(history.remove(*remove_), *remove_);
    if (note_) return changed(history.set_note(*number_, note_->substr(0, History::longest_note)), *number_);
    const std::vector<PastPrint> prints = wanted(history);
    if (csv_)
      show_table(csv_of(prints));
    else if (json_)
      show_all_json(prints, history);
    else
      show_all(prints, history);
    return Exit::success;
  }

 private:
  static constexpr std::uint64_t most_number = std::numeric_limits<std::int64_t>::max();

  /// The oldest first.
  std::vector<PastPrint> wanted(History& history) const {
    if (!number_) {
      std::vector<PastPrint> prints = history.list({}, all_prints);
      std::reverse(prints.begin(), prints.end());
      return prints;
    }
    const auto print = history.find(*number_);
    if (!print) refuse(*number_);
    return {*print};
  }

  static Exit changed(bool found, std::int64_t number) {
    if (!found) refuse(number);
    return Exit::success;
  }

  [[noreturn]] static void refuse(std::int64_t number) {
    throw core::DataError("", "", fmt::format("the history has no print {}", number),
                          "see `unicursal history`");
  }

  static void show_all_json(const std::vector<PastPrint>& prints, History& history) {
    nlohmann::json list = nlohmann::json::array();
    for (const PastPrint& print : prints) list.push_back(to_json(print));
    show_json({{"prints", list}, {"filaments", to_json(history.totals())["filaments"]}});
  }

  /// Its texts may be a stranger's, and must not command a terminal.
  static void show_table(const std::string& table) {
    if (::isatty(STDOUT_FILENO) == 1)
      show_text(stdout, table);
    else
      show_as_it_is(stdout, table);
  }

  void show_all(const std::vector<PastPrint>& prints, History& history) const {
    if (prints.empty()) show(stdout, "no print has ended yet\n");
    for (const PastPrint& print : prints) show_print(print);
    if (!number_) show_totals(history.totals());
  }

  std::optional<std::filesystem::path> spool_;
  std::optional<std::int64_t> number_, remove_;
  std::optional<std::string> note_;
  bool json_ = false, csv_ = false;
};

}  // namespace

std::unique_ptr<Command> make_history() {
  return std::make_unique<HistoryCommand>();
}

}  // namespace unicursal::host
