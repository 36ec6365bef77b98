// Asks for a printer in a terminal, and writes its profile.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/text/wording.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/doctor/examine.hpp"
#include "host/doctor/findings.hpp"
#include "host/doctor/reported_profile.hpp"
#include "host/engine/session.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/frames.hpp"
#include "host/job/profile.hpp"
#include "host/job/profile_draft.hpp"
#include "host/job/usual_profile.hpp"
#include "host/link/link.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

/// The user has said no.
struct Declined {};

/// One line from the user; Enter alone takes `usual`. Throws core::DataError when no more can come.
std::string ask(const std::string& question, const std::string& usual) {
  show(stdout, "{} [{}]: ", question, usual);
  std::fflush(stdout);
  std::string answer;
  if (!std::getline(std::cin, answer)) {
    throw core::DataError("", "", "the answers ended before the profile was whole",
                          "run `unicursal setup` in a terminal");
  }
  const std::size_t begin = answer.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return usual;
  return answer.substr(begin, answer.find_last_not_of(" \t\r") - begin + 1);
}

/// As many numbers as `usual` has, between the bounds; asks until they are.
std::vector<double> ask_numbers(const std::string& question, const std::vector<double>& usual, double least,
                                double greatest) {
  for (;;) {
    std::istringstream words(ask(question, fmt::format("{:g}", fmt::join(usual, " "))));
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    const bool inside = std::all_of(numbers.begin(), numbers.end(),
                                    [&](double number) { return number >= least && number <= greatest; });
    if (words.eof() && numbers.size() == usual.size() && inside) return numbers;
    show(stdout, "  please type {}, from {:g} to {:g}\n",
         usual.size() == 1 ? "a number" : fmt::format("{} numbers with spaces between them", usual.size()),
         least, greatest);
  }
}

class Setup final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, "setup", "Print",
                                "Ask for your printer and write its profile, the default from then on.",
                                "unicursal setup");
    add_value(app, "-o,--output", output_, "FILE",
              "The profile to write. Default: unicursal/printer.toml in ~/.config.");
    add_value(app, "--port", port_, "PORT", "The printer's port, auto, or none: do not ask for it.");
    add_value(app, "--baud", baud_, "RATE", "Bits per second. Default: 250000, then 115200.")
        .check(integer_between(300, 4'000'000));
    add_value(app, "--frame", frame_, "FRAME", "The shipped profile to begin with: do not ask for it.");
    add_note(app, "Nothing moves and nothing heats.");
    return app;
  }
  Exit run() override;

 private:
  fs::path chosen_output() const;
  std::optional<FoundPrinter> find_printer() const;
  std::optional<FoundPrinter> examined(const std::string& port) const;
  const ShippedFrame& chosen_frame(const FoundPrinter* printer) const;

  std::optional<fs::path> output_;
  std::optional<std::string> port_, frame_;
  std::optional<unsigned> baud_;
};

fs::path Setup::chosen_output() const {
  const std::optional<fs::path> file = output_ ? output_ : own_profile_path();
  if (!file) {
    throw core::DataError("", "", "the folder for your profile is unknown, since HOME is not set",
                          "name a file with --output");
  }
  std::error_code error;
  if (fs::exists(*file, error)) {
    const std::string answer = ask(file->string() + " exists. Replace it? yes or no", "no");
    if (answer != "yes" && answer != "y") throw Declined();
  }
  return *file;
}

/// Asks the printer at a port, at the usual rates; absent if it does not answer, which is said.
std::optional<FoundPrinter> Setup::examined(const std::string& port) const {
  std::vector<unsigned> rates{250000, 115200};
  if (baud_) rates = {*baud_};
  std::string problem;
  for (const unsigned baud : rates) {
    show(stdout, "asking the printer at {} baud …\n", baud);
    std::fflush(stdout);
    try {
      LinkOptions options = link_options(Profile{}, std::nullopt);
      options.temperatures = {};  // it would go on with automatic reports afterwards
      const int open = open_port(port, baud, options);
      return FoundPrinter{examine_port(open, options), baud, port};
    } catch (const PortError& error) {
      if (port_) throw;
      problem = error.what();
      break;  // at no other rate either
    } catch (const LinkError& error) {
      problem = error.what();
    }
  }
  if (!port_) show(stdout, "  {}\n", problem);
  return std::nullopt;
}

std::optional<FoundPrinter> Setup::find_printer() const {
  if (port_ == "none") return std::nullopt;
  const std::vector<PortInfo> ports = list_ports();
  if (!port_) {
    show(stdout, "{}\n", ports.empty() ? "no serial port is there" : "serial ports:");
    for (const PortInfo& port : ports) show(stdout, "  {}  {}\n", port.path, port.description);
  }
  for (;;) {
    const std::string port =
        port_ ? *port_
              : ask("Port: a name, auto, or none to go without the printer", ports.empty() ? "none" : "auto");
    if (port == "none") return std::nullopt;
    if (std::optional<FoundPrinter> found = examined(port)) {
      const auto known =
          std::find_if(ports.begin(), ports.end(), [&](const PortInfo& info) { return info.path == port; });
      if (known != ports.end() && !known->stable_path.empty()) found->port = known->stable_path;
      return found;
    }
    if (port_) {
      throw core::DataError("", "--port", "the printer there does not answer",
                            "switch it on, name another port, or write --port none");
    }
  }
}

std::string frame_names() {
  std::vector<std::string> names;
  for (const ShippedFrame& frame : frames()) names.emplace_back(frame.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

const ShippedFrame& Setup::chosen_frame(const FoundPrinter* printer) const {
  if (frame_) {
    if (const ShippedFrame* named = frame_named(*frame_)) return *named;
    throw core::DataError("", "--frame", "no shipped profile has that name", "choose among " + frame_names());
  }
  const ShippedFrame* usual = printer ? frame_of_machine(printer->examination.identity.machine) : nullptr;
  if (!usual) usual = frame_named("diamond-0.4");
  show(stdout, "shipped profiles:\n");
  for (const ShippedFrame& frame : frames()) {
    const gcode::Printer machine = profile_in(std::string(frame.text), fs::path(frame.name)).printer;
    show(stdout, "  {:<14} {}, {} feeders, {:g} x {:g} x {:g} mm\n", frame.name, machine.name,
         machine.feeders, machine.bed[0], machine.bed[1], machine.bed[2]);
  }
  for (;;) {
    const std::string name = ask("Which is most like yours", std::string(usual->name));
    if (const ShippedFrame* named = frame_named(core::lower(name))) return *named;
    show(stdout, "  please type one of these names\n");
  }
}

Exit Setup::run() {
  constexpr double least_width = 0.6, greatest_width = 2.5;  // of a bead ÷ nozzle
  try {
    show(stdout, "Enter alone takes what stands in brackets.\n");
    const fs::path output = chosen_output();
    const std::optional<FoundPrinter> found = find_printer();
    if (found) {
      const gcode::Identity& who = found->examination.identity;
      show(stdout, "found: {}{}{}\n", who.firmware, who.machine.empty() ? "" : ", ", who.machine);
    }
    const ShippedFrame& frame = chosen_frame(found ? &*found : nullptr);
    ProfileDraft draft{std::string(frame.text)};
    Profile profile = profile_in(draft.text(), output);
    if (found) note_reported(draft, *found, profile.printer);
    const double nozzle = ask_numbers("Opening of the nozzle, mm", {profile.printer.nozzle}, 0.1, 2).front();
    if (nozzle != profile.printer.nozzle) {
      draft.set("printer", "nozzle", fmt::format("{:g}", nozzle));
      draft.set("printer", "bead_width_range", toml_list({least_width * nozzle, greatest_width * nozzle}));
    }
    const auto& bed = profile.printer.bed;
    draft.set("printer", "bed",
              toml_list(ask_numbers("Size of the bed and height, mm", {bed.begin(), bed.end()}, 10, 2000)));
    const std::size_t feeders = profile_in(draft.text(), output).printer.feeders;
    std::vector<std::string> filaments;
    for (std::size_t feeder = 1; feeder <= feeders; ++feeder)
      filaments.push_back(toml_text(ask(fmt::format("Filament in feeder {}, for example red PLA", feeder),
                                        fmt::format("filament {}", feeder))));
    draft.set("extruder", "filaments", fmt::format("[{}]", fmt::join(filaments, ", ")));
    profile = profile_in(draft.text(), output);
    write_whole_file(output, draft.text());
    show(stdout, "written: {}\n", output.string());
    if (found)
      show(stdout, "{}", in_words(found->examination, findings(found->examination, found->baud, &profile)));
    show(stdout, "next: `unicursal tune transition {}` measures how fast its nozzle changes mixtures\n",
         output.string());
    return Exit::success;
  } catch (const Declined&) {
    show(stdout, "nothing was changed\n");
    return Exit::stopped;
  }
}

}  // namespace

std::unique_ptr<Command> make_setup() {
  return std::make_unique<Setup>();
}

}  // namespace unicursal::host
