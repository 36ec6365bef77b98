// What a command of the program is. Each has a file of its own name (daemon commands that differ by one word
// share a file), which defines a class with its options and one of the functions below. A new command is
// that file, a line here and a line in the list of cli.cpp.
#pragma once

#include <memory>

#include "host/cli/exit.hpp"

namespace CLI {
class App;
}

namespace unicursal::host {

class Command {
 public:
  Command() = default;
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// Adds the command with its options to the program and returns it. Parsing writes the options
  /// into this object.
  virtual CLI::App& declare(CLI::App& program) = 0;
  /// Runs the command after its options have been parsed. Throws; exit.hpp maps exceptions to exit codes.
  virtual Exit run() = 0;
};

std::unique_ptr<Command> make_dry_run();
std::unique_ptr<Command> make_plan();
std::unique_ptr<Command> make_mix();
std::unique_ptr<Command> make_curve();
std::unique_ptr<Command> make_simulate();

std::unique_ptr<Command> make_inspect();
std::unique_ptr<Command> make_colours();
std::unique_ptr<Command> make_new();

std::unique_ptr<Command> make_setup();
std::unique_ptr<Command> make_ports();
std::unique_ptr<Command> make_doctor();
std::unique_ptr<Command> make_tune();
std::unique_ptr<Command> make_load();
std::unique_ptr<Command> make_purge();
std::unique_ptr<Command> make_unload();
std::unique_ptr<Command> make_print();
std::unique_ptr<Command> make_resume();
std::unique_ptr<Command> make_history();

std::unique_ptr<Command> make_serve();
std::unique_ptr<Command> make_queue();
std::unique_ptr<Command> make_start();
std::unique_ptr<Command> make_status();
std::unique_ptr<Command> make_pause();
std::unique_ptr<Command> make_answer();
std::unique_ptr<Command> make_cancel();
std::unique_ptr<Command> make_stop();
std::unique_ptr<Command> make_set();
std::unique_ptr<Command> make_token();
std::unique_ptr<Command> make_keys();

std::unique_ptr<Command> make_completion();

std::unique_ptr<Command> make_check_job();

}  // namespace unicursal::host
