#include "host/doctor/examine.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/doctor/findings.hpp"
#include "host/engine/session.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {
namespace {

class Doctor final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, "doctor", "Print",
                                "Ask a printer what it can do and report what would go wrong.",
                                "unicursal doctor --port auto --profile diamond.toml");
    declare_port(app, port_, "the profile's port, or auto");
    add_value(app, "--profile", profile_, "PROFILE", "Compare the printer with this profile.");
    add_value(app, "--baud", baud_, "RATE", "Bits per second. Default: the profile's rate, or 250000.")
        .check(integer_between(300, 4'000'000));
    app.add_flag("--json", json_, "Write the findings as JSON.")->group("Output");
    declare_log(app, log_);
    add_note(app, "Nothing moves and nothing heats. The exit code is 2 if a print would be refused.");
    return app;
  }
  Exit run() override;

 private:
  std::optional<std::string> port_;
  std::optional<std::filesystem::path> profile_, log_;
  std::optional<unsigned> baud_;
  bool json_ = false;
};

Exit Doctor::run() {
  check_outputs(present({profile_}), present({log_}));
  const Profile profile = profile_ ? load_profile(*profile_) : Profile{};
  const unsigned baud = baud_.value_or(profile.baud);
  LinkOptions options = link_options(profile, log_);
  options.temperatures = {};  // the examination asks for them: automatic reports would go on afterwards
  const int port = open_port(port_.value_or(profile.port), baud, options);
  const Examination found = examine_port(port, options);
  const std::vector<Finding> list = findings(found, baud, profile_ ? &profile : nullptr);
  if (json_)
    show_json_text(stdout, to_json(found, list).dump(2));
  else
    show(stdout, "{}", in_words(found, list));
  return has_trouble(list) ? Exit::bad_input : Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_doctor() {
  return std::make_unique<Doctor>();
}

}  // namespace unicursal::host
