#include "host/daemon/serve.hpp"

#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"

namespace unicursal::host {

Exit serve(const ServeOptions& options) {
  serve(options, [&](const std::string& address) {
    show(stdout, "listening on http://{}{}\n", address,
         options.no_token ? ", without a token"
                          : "; the token is in " + options.daemon.state.string() + "/token");
    std::fflush(stdout);
  });
  return Exit::success;
}

}  // namespace unicursal::host
