// The commands that ask a daemon to do one thing with its print: pause, answer, cancel, stop. `unicursal
// resume` is in resume.cpp, since it also resumes interrupted prints.
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"

namespace unicursal::host {
namespace {

class Steering final : public Command {
 public:
  Steering(const char* action, const char* summary) : action_(action), summary_(summary) {}

  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, action_, "Daemon", summary_, std::string("unicursal ") + action_);
    access_.declare(app);
    return app;
  }

  Exit run() override {
    steer(access_, action_);
    return Exit::success;
  }

 private:
  const char* action_;
  const char* summary_;
  DaemonAccess access_;
};

class AnswerQuestion final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "answer", "Daemon",
                    "Answer the question that the daemon's printer asks, by the number of a button.",
                    "unicursal answer 1");
    add_value(app, "NUMBER", button_, " ", "The button's number, from 0; `unicursal status` shows them.")
        .required()
        ->check(integer_between(0, 9));
    access_.declare(app);
    return app;
  }
  Exit run() override {
    access_.show_status(accepted(access_.connect().ask("POST", "/api/print/answer", {{"button", button_}})));
    return Exit::success;
  }

 private:
  int button_ = 0;
  DaemonAccess access_;
};

}  // namespace

std::unique_ptr<Command> make_answer() {
  return std::make_unique<AnswerQuestion>();
}

std::unique_ptr<Command> make_pause() {
  return std::make_unique<Steering>("pause", "Park the daemon's print until `unicursal resume`.");
}

std::unique_ptr<Command> make_cancel() {
  return std::make_unique<Steering>("cancel",
                                    "End the daemon's print: park the nozzle and switch the heat off.");
}

std::unique_ptr<Command> make_stop() {
  return std::make_unique<Steering>(
      "stop", "Stop the daemon's printer at once (M112). The printer needs a reset afterwards.");
}

}  // namespace unicursal::host
