// The part of the daemon that asks a printer what it can do, and keeps the profile of the printer.
#include <fmt/format.h>

#include <algorithm>

#include "core/text/file_bytes.hpp"
#include "core/text/printable.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/refused.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/frames.hpp"
#include "host/job/usual_profile.hpp"
#include "host/link/find_port.hpp"

namespace unicursal::host {
namespace {

/// How an examination talks to the printer; automatic reports of heat would go on afterwards.
LinkOptions asking_options(const Profile& profile) {
  LinkOptions options = link_options(profile, std::nullopt);
  options.temperatures = {};
  return options;
}

/// Sets a flag as long as it lives.
class Raised {
 public:
  explicit Raised(std::shared_ptr<bool> flag) : flag_(std::move(flag)) { *flag_ = true; }
  ~Raised() { *flag_ = false; }
  Raised(const Raised&) = delete;
  Raised& operator=(const Raised&) = delete;

 private:
  const std::shared_ptr<bool> flag_;
};

}  // namespace

asio::awaitable<std::vector<PortInfo>> Daemon::ports() {
  return elsewhere(disk_, [] { return list_ports(); });
}

/// The idle connection comes back behind it.
asio::awaitable<FoundPrinter> Daemon::examine_printer(std::string named) {
  check_idle();
  check_nothing_interrupted();
  if (idle_.feeding()) check_not_at_work();
  const std::string port = checked_port(named);
  const Profile profile = own() ? *own() : Profile{};
  const bool was_open = idle_.wanted();
  const std::string before = idle_.status().port;
  std::vector<unsigned> rates{profile.baud};
  if (!own()) rates.push_back(115200);
  const Raised examining(examining_);
  int descriptor = -1;
  if (before == port)
    descriptor = co_await idle_.hand_over();
  else
    co_await idle_.close();  // another printer: it is cooled
  const bool taken_over = descriptor >= 0;
  std::string problem;
  for (const unsigned baud : rates) {
    try {
      FoundPrinter found = co_await examine_at(port, baud, descriptor);
      if (taken_over) idle_.leave_heat_to_print();
      if (was_open || idle_.may_be_hot()) idle_.connect(profile, before);
      co_return found;
    } catch (const PortError& error) {
      problem = error.what();
      break;                                 // at no other rate either
    } catch (const std::exception& error) {  // a LinkError: perhaps at another rate
      problem = error.what();
    }
  }
  if (was_open || idle_.may_be_hot()) idle_.connect(profile, before);
  throw Refused(Why::absent, "not_examined", problem);
}

/// `descriptor`: of the open port; it is used up. −1: the port is opened.
asio::awaitable<FoundPrinter> Daemon::examine_at(const std::string& port, unsigned baud, int& descriptor) {
  LinkOptions options = asking_options(own() ? *own() : Profile{});
  int open = std::exchange(descriptor, -1);
  const auto open_it = [&] { return open_port(port, baud, options); };
  if (open >= 0)
    options.boot = {};
  else
    open = co_await elsewhere(opening_, open_it);
  const std::string device = device_of(open), stable = stable_name_of(device);
  Link link(loop_.get_executor(), open, options);
  FoundPrinter found;
  found.examination = co_await examine(link, loop_.get_executor(), options.clock);
  found.baud = baud;
  found.port = port;
  if (found.port == device && !stable.empty()) found.port = stable;
  co_return found;
}

// ---- the profile

asio::awaitable<Daemon::ProfileAsText> Daemon::profile_text() {
  const auto file = profile_file();
  if (!file)
    throw Refused(Why::not_found, "no_profile", "this daemon has no profile of its printer; make one");
  const auto read = [file = *file] { return ProfileAsText{file, core::file_bytes(file)}; };
  co_return co_await elsewhere(disk_, read);
}

/// Throws JobError if it is not a profile, and FileError if it cannot be written.
asio::awaitable<void> Daemon::keep_profile(std::filesystem::path file, std::string text) {
  check_idle();
  const Profile profile = profile_in(text, file);
  const bool exists = std::filesystem::exists(file);
  const auto write = [&] {
    write_whole_file(file, text, exists ? WholeFile::Access::as_before : WholeFile::Access::usual);
    return true;
  };
  co_await elsewhere(disk_, write);
  (options_.profile ? profile_ : own_profile_) = profile;
  idle_.use(profile);
  show_idle_soon();
}

/// Where a new profile goes. Throws Refused.
std::filesystem::path Daemon::new_profile_file(bool replace) const {
  if (options_.profile)
    throw Refused(
        Why::conflict,
        "the daemon was started with --profile: change that profile, or start the daemon without it to "
        "make one of your own");
  const auto file = own_profile_path();
  if (!file)
    throw Refused(Why::conflict,
                  "the folder for your profile is unknown, since HOME is not set; start the daemon with "
                  "--profile");
  if (!replace && std::filesystem::exists(*file))
    throw Refused(Why::conflict,
                  core::printable(file->string()) + " exists; change it, or say that it is to be replaced");
  return *file;
}

}  // namespace unicursal::host
