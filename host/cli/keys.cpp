#include <fmt/format.h>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/state_folder.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

class KeysCommand final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "keys", "Daemon",
                    "List, make and remove keys: one each for a slicer, a phone, a home automation.",
                    "unicursal keys --new PrusaSlicer --right queue");
    const auto any = integer_between(0, std::numeric_limits<std::uint64_t>::max());
    CLI::Option& make = add_value(app, "--new", new_, "NAME", "Make a key of this name, and show it.");
    CLI::Option& grant =
        add_value(app, "--grant", grant_, "NUMBER", "Give a key to the program that asks under this number.");
    CLI::Option& deny = add_value(app, "--deny", deny_, "NUMBER", "Refuse it.");
    CLI::Option& remove = add_value(
        app, "--remove", remove_, "NUMBER",
        "Remove the key of this number. It is void at once; programs of the network are disconnected "
        "and connect again.");
    grant.check(any)->excludes(&make);
    deny.check(any)->excludes(&make)->excludes(&grant);
    remove.check(any)->excludes(&make)->excludes(&grant)->excludes(&deny);
    add_value(app, "--right", right_, "watch|queue|steer",
              "What the key lets its program do: watch; queue, that is also to send files and to change the "
              "queue; or steer, that is also to start, pause and end prints. Default: steer.")
        .check(one_of({"watch", "queue", "steer"}));
    declare_state(app, state_);
    add_note(
        app,
        "Without options the command lists the keys, and the programs that ask for one now. Slicers send "
        "the key as that of an OctoPrint. `unicursal token --renew` leaves keys as they are.");
    return app;
  }

  Exit run() override {
    const std::filesystem::path folder = state_ ? *state_ : default_state_folder();
    const auto client = Client::find(folder);
    if (!client)
      throw DaemonError(folder.string(), "", "no daemon runs with this state folder",
                        "start one with `unicursal serve`, or name its folder with --state");
    json body = json::object();
    if (!right_.empty()) body["right"] = right_;
    if (new_) {
      body["name"] = *new_;
      const json made = accepted(client->ask("POST", "/api/keys", body));
      show(stdout, "{}\n", made.at("key").get<std::string>());
    } else if (grant_ || deny_) {
      body["grant"] = grant_.has_value();
      accepted(client->ask("POST", fmt::format("/api/keys/{}", grant_ ? *grant_ : *deny_), body));
    } else if (remove_) {
      accepted(client->ask("DELETE", fmt::format("/api/keys/{}", *remove_)));
    } else {
      list(accepted(client->ask("GET", "/api/keys")));
    }
    return Exit::success;
  }

 private:
  static void list(const json& answer) {
    for (const json& key : answer.at("keys"))
      show(stdout, "{} {}: {}, {}\n", key.at("id").get<std::uint64_t>(), key.at("name").get<std::string>(),
           key.at("right").get<std::string>(), key.at("key").get<std::string>());
    if (answer.at("keys").empty())
      show(stdout, "a key does not exist yet; `unicursal keys --new NAME` makes one\n");
    for (const json& one : answer.at("requests"))
      show(stdout, "\"{}\" at {} asks for a key: `unicursal keys --grant {}` or --deny\n",
           one.at("name").get<std::string>(), one.at("from").get<std::string>(),
           one.at("id").get<std::uint64_t>());
  }

  std::optional<std::string> new_;
  std::optional<std::uint64_t> grant_, deny_, remove_;
  std::string right_;
  std::optional<std::filesystem::path> state_;
};

}  // namespace

std::unique_ptr<Command> make_keys() {
  return std::make_unique<KeysCommand>();
}

}  // namespace unicursal::host
