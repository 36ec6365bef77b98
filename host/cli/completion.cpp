#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/completion_scripts.hpp"
#include "host/cli/terminal_output.hpp"

namespace unicursal::host {
namespace {

class CompletionCommand final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "completion", "Shell",
                    "Write the script with which a shell completes commands, options and files.",
                    "unicursal completion bash > ~/.local/share/bash-completion/completions/unicursal");
    add_note(
        app,
        "The package brings these scripts. For one session: eval \"$(unicursal completion bash)\", the same "
        "with zsh after compinit, or unicursal completion fish | source.");
    add_value(app, "SHELL", shell_, " ", "bash, zsh or fish.")
        .required()
        ->check(one_of({"bash", "zsh", "fish"}));
    return app;
  }

  Exit run() override {
    show_as_it_is(stdout, shell_ == "bash"  ? bash_completion
                          : shell_ == "zsh" ? zsh_completion
                                            : fish_completion);
    return Exit::success;
  }

 private:
  std::string shell_;
};

}  // namespace

std::unique_ptr<Command> make_completion() {
  return std::make_unique<CompletionCommand>();
}

}  // namespace unicursal::host
