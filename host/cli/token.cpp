#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/state_folder.hpp"

namespace unicursal::host {
namespace {

class Token final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, "token", "Daemon",
                                "Show or renew the token that programs need to control the daemon.",
                                "unicursal token --renew");
    app.add_flag(
        "--renew", renew_,
        "Make new tokens. The old ones are void at once, and programs that used them are disconnected.");
    declare_state(app, state_);
    add_note(
        app,
        "The commands of this user need no token: they use the socket in the state folder. After --renew, "
        "Prometheus needs the new text of the file metrics-token.");
    return app;
  }

  Exit run() override {
    const std::filesystem::path folder = state_ ? *state_ : default_state_folder();
    const auto client = Client::find(folder);
    if (renew_ && client)
      accepted(client->ask("POST", "/api/token/renew", nlohmann::json::object()));
    else if (renew_)
      renew_at_rest(folder);
    if (const auto token = read_line(folder / "token")) {
      show(stdout, "{}\n", *token);
      return Exit::success;
    }
    throw DaemonError(folder.string(), "", "holds no token",
                      "start a daemon with `unicursal serve`, which makes one");
  }

 private:
  /// No daemon runs; while this one holds the folder, none can begin.
  static void renew_at_rest(const std::filesystem::path& folder) {
    const StateFolder state(folder);
    state.renewed("token");
    state.renewed("metrics-token");
  }

  bool renew_ = false;
  std::optional<std::filesystem::path> state_;
};

}  // namespace

std::unique_ptr<Command> make_token() {
  return std::make_unique<Token>();
}

}  // namespace unicursal::host
