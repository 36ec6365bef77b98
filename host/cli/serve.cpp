#include "host/daemon/serve.hpp"

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/qr_code.hpp"
#include "host/cli/terminal_look.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/openapi.hpp"
#include "host/daemon/state_folder.hpp"

namespace unicursal::host {
namespace {

class Serve final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    DaemonOptions& daemon = options_.daemon;
    constexpr auto network = "Network";
    CLI::App& app = add_command(program, "serve", "Daemon",
                                "Own the printer, keep a queue of jobs, and be controlled over HTTP.",
                                "unicursal serve --port /dev/ttyUSB0 --profile diamond.toml --jobs ~/jobs");
    declare_port(app, daemon.port, "the profile's port");
    add_value(app, "--profile", daemon.profile, "PROFILE",
              "Use this printer profile for all jobs instead of the profiles that they name.");
    add_values(app, "--jobs", daemon.jobs, "DIR", "Folder of jobs that clients may queue. May be repeated.");
    add_value(app, "--listen", listen_, "ADDRESS",
              "Address and port. Default: 127.0.0.1:8377, or 0.0.0.0:8377 with --lan.")
        .group(network);
    app.add_flag("--lan", options_.lan,
                 "Let other computers of this network in, with the token, by this computer's addresses, its "
                 "name, and its name with .local. A terminal shows the page's address with the token, as a "
                 "QR code: whoever sees it can control the printer.")
        ->group(network);
    add_values(app, "--name", options_.names, "HOST",
               "Additional host name to accept in requests. May be repeated.")
        .group(network);
    app.add_flag("--no-token", options_.no_token,
                 "Let every user of this computer control the printer. Only with a loopback address.")
        ->group(network);
    add_value(app, "--web-folder", options_.web_folder, "DIR",
              "Take the files of the page from this folder instead of the program, while they are developed.")
        .group(network);
    add_value(app, "--check-memory", memory_, "MB",
              "Memory that the check of an uploaded job may take. Default: 1024.")
        .check(integer_between(64, most_megabytes));
    add_value(app, "--check-time", time_, "S",
              "Time in which an uploaded job must have been read. Default: 20.")
        .check(integer_between(1, longest_check));
    app.add_flag(
        "--start-uploads", daemon.start_uploads,
        "Start files that a slicer sends to be printed, once the bed was confirmed clear with `unicursal "
        "queue --bed-clear` and nothing has been printed since.");
    app.add_flag("--openapi", openapi_, "Write a description of the HTTP interface as OpenAPI 3.1, and end.");
    add_value(app, "--on-event", daemon.on_event, "COMMAND",
              "Run this command (by sh) when a print has started, is paused, asks a question, has a problem "
              "or has ended. It gets a JSON object on standard input.");
    declare_state(app, state_);
    declare_spool(app, daemon.spool);
    declare_pause_heat(app, daemon.pause_heat);
    add_note(
        app,
        "A print never starts by itself, because the last part may still lie on the bed: "
        "`unicursal start` starts it; but see --start-uploads. SIGTERM, SIGHUP, SIGQUIT or Ctrl-C parks and "
        "cools the current print, "
        "then ends the daemon; a second one stops the printer at once. API.md describes the HTTP interface.");
    return app;
  }

  Exit run() override {
    if (openapi_) {
      show_as_it_is(stdout, openapi_document().dump(1) + "\n");
      return Exit::success;
    }
    if (memory_) options_.daemon.upload_limits.memory = *memory_ * 1024 * 1024;
    if (time_) options_.daemon.upload_limits.time = std::chrono::seconds(*time_);
    options_.daemon.state = state_ ? *state_ : default_state_folder();
    if (listen_ || options_.lan) options_.listen = listen_.value_or("0.0.0.0:8377");
    serve(options_, [&](const std::string& address) {
      show(stdout, "listening on http://{}{}\n", address,
           options_.no_token ? ", without a token"
                             : "; the token is in " + options_.daemon.state.string() + "/token");
      show_page_address(address);
      if (options_.lan)
        show(stdout, "on another computer: `unicursal status --daemon http://{} --token TOKEN`\n", address);
      std::fflush(stdout);
    });
    return Exit::success;
  }

 private:
  /// With the token behind the `#`, which browsers do not send and servers do not log. A terminal shows it to
  /// whoever has started the daemon and could read the token anyway; a file or the system's log would keep it
  /// for others.
  void show_page_address(const std::string& address) const {
    if (isatty(STDOUT_FILENO) == 0) return;
    const auto token = options_.no_token ? std::nullopt : read_line(options_.daemon.state / "token");
    const std::string page = "http://" + within_reach(address) + "/" + (token ? "#token=" + *token : "");
    if (options_.lan && look_of(STDOUT_FILENO).rewrites) show_as_it_is(stdout, qr_code(page));
    show_as_it_is(stdout, "open " + page + "\n");
  }

  /// A daemon that listens on all addresses is reached by that of this computer.
  static std::string within_reach(const std::string& address) {
    constexpr std::string_view everywhere = "0.0.0.0:";
    return address.starts_with(everywhere) ? "127.0.0.1:" + address.substr(everywhere.size()) : address;
  }

  static constexpr std::uint64_t most_megabytes = 1 << 24;
  static constexpr std::uint64_t longest_check = 600;  ///< s; the commands wait a little longer

  ServeOptions options_;
  bool openapi_ = false;
  std::optional<std::string> listen_;
  std::optional<std::filesystem::path> state_;
  std::optional<std::uint64_t> memory_;
  std::optional<std::uint32_t> time_;
};

}  // namespace

std::unique_ptr<Command> make_serve() {
  return std::make_unique<Serve>();
}

}  // namespace unicursal::host
