// `unicursal load`, `unicursal purge` and `unicursal unload`.
#include <fmt/format.h>

#include <iostream>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_feeding.hpp"
#include "host/cli/foreground.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/feeding/feeding.hpp"
#include "host/tune/terminal_reader.hpp"

namespace unicursal::host {
namespace {

/// What one of the three commands says.
struct FeedWords {
  const char* name;
  const char* summary;
  const char* example;
  const char* feeder_help;
  const char* length_help;
  const char* note;
  const char* question;  ///< `{}`: the feeder
  const char* done;      ///< `{0}`: the feeder, `{1}`: mm
};

constexpr FeedWords load_words{
    "load",
    "Feed filament into the hot end until it leaves the nozzle.",
    "unicursal load diamond.toml --feeder 2 --port auto",
    "Feeder to load, counted from 1.",
    "How far its filament moves, 1 to 2000 mm. Default: 60, and the length of the tube if the profile "
    "has it.",
    "Push the filament into the feeder until its gear holds it. The other feeders turn a little as well, "
    "so that their inlets do not clog.",
    "Is filament in the gear of {}? The axes home, and the nozzle drips: is the bed clear?",
    "{} has fed {:g} mm"};
constexpr FeedWords purge_words{
    "purge",
    "Push out what is left of former colours.",
    "unicursal purge diamond.toml --port auto",
    "Feeder to purge, counted from 1. Default: one after the other, then all together.",
    "How far the filament of each feeder moves, 1 to 2000 mm. Default: 20.",
    "A Diamond hot end clogs at an inlet whose filament stands still. Purge all feeders after loading, "
    "and before a print if the printer has stood for days.",
    "Are all feeders loaded? The axes home, and the nozzle drips: is the bed clear?",
    "{} has fed {:g} mm"};
constexpr FeedWords unload_words{
    "unload",
    "Pull filament out of the hot end.",
    "unicursal unload diamond.toml --feeder 2 --port auto",
    "Feeder to unload, counted from 1.",
    "How far its filament is pulled back, 1 to 2000 mm. Default: 100, or the length of the tube and 80 "
    "if the profile has it.",
    "All feeders push 5 mm together first; then only this one moves. Load its inlet again before the "
    "next print.",
    "May {} let its filament go? The axes home, and the nozzle drips: is the bed clear?",
    "{} has pulled {:g} mm back"};

const FeedWords& words_for(FeedingKind kind) {
  if (kind == FeedingKind::load) return load_words;
  return kind == FeedingKind::purge ? purge_words : unload_words;
}

class Feed final : public Command {
 public:
  explicit Feed(FeedingKind kind) : kind_(kind), words_(words_for(kind)) {}

  CLI::App& declare(CLI::App& program) override;
  Exit run() override;

 private:
  std::string who() const { return feeder_ ? fmt::format("feeder {}", *feeder_) : "each feeder"; }
  FeedingOrder order() const;
  Feeding announced(const Profile& profile) const;
  bool agreed() const;
  bool ready() const;
  std::optional<Client> daemon(const std::optional<Profile>& profile) const;
  Exit feed(const Feeding& feeding, const Profile& profile) const;
  Exit feed_by(const Client& daemon) const;
  Exit show_end(Exit exit, double length) const;

  const FeedingKind kind_;
  const FeedWords& words_;
  std::optional<std::filesystem::path> profile_;
  std::optional<std::size_t> feeder_;  ///< counted from 1
  std::optional<double> length_;
  std::optional<std::string> port_;
  std::optional<std::filesystem::path> log_;
  bool yes_ = false;
  DaemonAccess access_;
};

CLI::App& Feed::declare(CLI::App& program) {
  CLI::App& app = add_command(program, words_.name, "Print", words_.summary, words_.example);
  CLI::Option& profile = add_value(app, "PROFILE", profile_, " ",
                                   "The printer's profile: see unicursal-profile(5). Default: the daemon's.");
  CLI::Option* feeder =
      add_value(app, "--feeder", feeder_, "FEEDER", words_.feeder_help).check(integer_between(1, 8));
  if (kind_ != FeedingKind::purge) feeder->required();
  add_value(app, "--length", length_, "MM", words_.length_help).check(number_between(1, 2000));
  declare_port(app, port_, "the profile's port, or auto");
  app.add_flag("--yes", yes_, "Do not ask whether the printer is ready.");
  declare_log(app, log_);
  access_.declare_place(app);
  for (const char* local : {"--port", "--log"}) app.get_option(local)->needs(&profile);
  for (const char* of_daemon : {"--daemon", "--token"}) app.get_option(of_daemon)->excludes(&profile);
  add_note(app, words_.note);
  add_note(
      app,
      "The axes are homed, and the nozzle is heated to the profile's temperature above the front edge of the "
      "bed. It is switched off afterwards, also after Ctrl-C or an error. The bed stays as warm as it is.");
  add_note(
      app,
      "If a daemon of yours has the printer, it moves the filament, with its own profile, unless it prints. "
      "A daemon that had not connected the printer switches the bed off, too, when it disconnects.");
  return app;
}

FeedingOrder Feed::order() const {
  FeedingOrder order{kind_, {}, length_};
  if (feeder_) order.feeder = *feeder_ - 1;
  return order;
}

Feeding Feed::announced(const Profile& profile) const {
  Feeding made = feeding(order(), profile);
  show(stdout, "heats to {:g} °C, then moves {:g} mm of filament in {}, in about {}\n",
       profile.printer.nozzle_temperature, made.length, who(), rough_duration(made.seconds));
  return made;
}

Exit Feed::run() {
  if (profile_) check_outputs({*profile_}, present({log_}));
  std::optional<Profile> profile;
  if (profile_) profile = load_profile(*profile_);
  if (const std::optional<Client> holder = daemon(profile)) return feed_by(*holder);
  const Feeding made = announced(*profile);
  return agreed() ? feed(made, *profile) : Exit::stopped;
}

/// Absent: the printer is this command's own.
std::optional<Client> Feed::daemon(const std::optional<Profile>& profile) const {
  if (!profile) {
    if (access_.remote() || access_.token) return access_.connect();
    if (auto own = own_daemon(access_)) return own;
    throw DaemonError("", "PROFILE", "is missing, and no daemon of yours runs that would have one",
                      "name the printer's profile, or start a daemon with `unicursal serve`");
  }
  std::optional<Client> client =
      daemon_with_port(access_, port_.value_or(profile->port), profile->printer.name);
  if (client && log_)
    throw DaemonError("", "--log", "is not possible, since a daemon has the printer",
                      "leave it out, or end the daemon");
  return client;
}

Exit Feed::feed_by(const Client& daemon) const {
  const Profile profile = profile_of(daemon);
  show(stdout, "the daemon moves the filament\n");
  const Feeding made = announced(profile);
  return agreed() ? show_end(feed_by_daemon(daemon, order()), made.length) : Exit::stopped;
}

bool Feed::agreed() const {
  if (yes_ || ready()) return true;
  show(stdout, "nothing has moved or heated\n");
  return false;
}

bool Feed::ready() const {
  try {
    return confirmed(std::cin, std::cout, fmt::format(fmt::runtime(words_.question), who()));
  } catch (const TuningCancelled&) {  // the input has ended
    return false;
  }
}

Exit Feed::feed(const Feeding& made, const Profile& profile) const {
  FeedingSource source(made, profile.printer);
  StreamSettings settings;
  settings.profile = profile.file;
  settings.link = link_options(profile, log_);
  StatusLook look;
  look.feeds = true;
  const bool stopped = stream_or_cool(port_.value_or(profile.port), profile, source, settings, look);
  return show_end(stopped ? Exit::stopped : Exit::success, made.length);
}

Exit Feed::show_end(Exit exit, double length) const {
  if (exit == Exit::stopped)
    show(stdout, "stopped; the nozzle cools\n");
  else
    show(stdout, "{}; the nozzle cools\n", fmt::format(fmt::runtime(words_.done), who(), length));
  return exit;
}

}  // namespace

std::unique_ptr<Command> make_load() {
  return std::make_unique<Feed>(FeedingKind::load);
}
std::unique_ptr<Command> make_purge() {
  return std::make_unique<Feed>(FeedingKind::purge);
}
std::unique_ptr<Command> make_unload() {
  return std::make_unique<Feed>(FeedingKind::unload);
}

}  // namespace unicursal::host
