#include "host/doctor/examine.hpp"

#include <fmt/format.h>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <exception>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/doctor/findings.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {
namespace {

Examination examine_port(int port, const LinkOptions& options) {
  asio::io_context loop{1};
  Link link(loop.get_executor(), port, options);
  Examination found;
  std::exception_ptr failure;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> { found = co_await examine(link, loop.get_executor(), options.clock); },
      [&](std::exception_ptr thrown) {
        failure = thrown;
        loop.stop();
      });
  loop.run();
  if (failure) std::rethrow_exception(failure);
  return found;
}

}  // namespace

Exit doctor(const DoctorCommand& command) {
  check_outputs(present({command.profile}), present({command.log}));
  const bool told = command.profile.has_value();
  const Profile profile = told ? load_profile(*command.profile) : Profile{};
  const unsigned baud = command.baud.value_or(profile.baud);
  LinkOptions options = link_options(profile, command.log);
  options.temperatures = {};  // asked for, so that reports do not go on afterwards
  const int port = open_port(command.port.value_or(profile.port), baud, options);
  const Examination found = examine_port(port, options);
  const std::vector<Finding> list = findings(found, baud, told ? &profile : nullptr);
  if (command.json)
    show(stdout, "{}\n", to_json(found, list).dump(2));
  else
    show(stdout, "{}", in_words(found, list));
  return has_trouble(list) ? Exit::failed : Exit::success;
}

}  // namespace unicursal::host
