#include "host/cli/cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/model/noted_error.hpp"
#include "host/cli/command.hpp"
#include "host/cli/completing.hpp"
#include "host/cli/help_format.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/cli/version.hpp"
#include "host/cli/wrong_usage.hpp"

namespace unicursal::host {
namespace {

/// All commands, in the order of the help.
constexpr std::unique_ptr<Command> (*makers[])() = {
    make_inspect, make_new,        make_colours,                               // a model
    make_dry_run, make_plan,       make_mix,      make_curve,  make_simulate,  // without a printer
    make_setup,   make_ports,      make_doctor,   make_tune,   make_load,
    make_purge,   make_unload,     make_print,    make_resume, make_history,  // with a printer
    make_serve,   make_queue,      make_start,    make_status, make_pause,    // with a daemon
    make_answer,  make_cancel,     make_stop,     make_set,    make_token,
    make_keys,    make_completion, make_check_job};  // of the daemon's own

class CommandLine {
 public:
  CommandLine() {
    app_.formatter(std::make_shared<HelpFormat>());
    app_.set_version_flag("--version", std::string("unicursal ") + version, "Print the version.");
    app_.set_help_flag("-h,--help", "Print this help.");
    app_.require_subcommand(1);
    app_.footer(
        "`unicursal COMMAND --help` describes the options of a command and gives an example. unicursal(1) is "
        "the manual.\n\n"
        "Exit codes: 0 success; 1 the print or the simulation failed; 2 the input or the printer was refused "
        "and nothing has moved or heated; 3 the user ended the print.");
    for (const auto make : makers) {
      std::unique_ptr<Command> command = make();
      CLI::App& app = command->declare(app_);
      commands_.push_back({std::move(command), &app});
    }
  }

  Exit run(int argc, char** argv) {
    // The rest is an unfinished command line, which cannot be parsed.
    if (argc > 1 && std::string_view(argv[1]) == "complete") {
      show(stdout, "{}", answer_of(completion_of(app_, {argv + 2, argv + argc})));
      return Exit::success;
    }
    check_words(app_, argc, argv);
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& answer) {
      // CLI11 reports --help and --version as exceptions.
      return app_.exit(answer) == 0 ? Exit::success : Exit::failed;
    } catch (const CLI::ParseError& error) {
      throw usage_error(app_, error);
    }
    for (const auto& [command, app] : commands_) {
      if (app->parsed()) return command->run();
    }
    return Exit::bad_input;  // never: the parser requires a command
  }

 private:
  struct Declared {
    std::unique_ptr<Command> command;
    CLI::App* app;
  };

  CLI::App app_{
      "Prints each layer as one closed space-filling curve, on printers with two to eight feeders "
      "and one mixing nozzle.",
      "unicursal"};
  std::vector<Declared> commands_;
};

}  // namespace

int run_command_line(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed terminal must not end a print
  std::signal(SIGXFSZ, SIG_IGN);  // nor must a limit on file sizes: it is reported like a full disk
  try {
    return static_cast<int>(CommandLine().run(argc, argv));
  } catch (const std::exception& error) {
    if (const auto* refusal = dynamic_cast<const core::NotedError*>(&error)) {
      for (const std::string& note : refusal->notes()) show_note(note);
    }
    show(stderr, "unicursal: {}\n", sentence_of(error));
    return static_cast<int>(exit_of(error));
  }
}

}  // namespace unicursal::host
