#include "host/daemon/serve.hpp"

#include <fmt/format.h>

#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "host/daemon/api.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/own_addresses.hpp"
#include "host/daemon/service_notify.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/http/http_server.hpp"
#include "host/loop/print_signals.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

/// Time by which systemd is repeatedly asked to extend its limit while the printer parks and cools.
constexpr std::chrono::microseconds parking_time = 60s;

constexpr auto longest_end = 1s;  ///< for the threads, once no print is left

constexpr auto farewell = 300ms;  ///< for clients to close at the daemon's end

asio::ip::tcp::endpoint checked_endpoint(const ServeOptions& options) {
  const auto at = parse_endpoint(options.listen);
  if (options.no_token && !at.address().is_loopback()) {
    throw core::DataError("", "--no-token", "is refused for " + options.listen + ", which others can reach",
                          "leave out --no-token, or listen on 127.0.0.1");
  }
  if (options.lan && at.address().is_loopback()) {
    throw core::DataError("", "--lan",
                          "is refused with --listen " + options.listen + ", which others cannot reach",
                          "leave out --listen, or write for example 0.0.0.0:8377");
  }
  return at;
}

std::string words(const asio::ip::tcp::endpoint& at) {
  const std::string address = at.address().to_string();
  return at.address().is_v6() ? fmt::format("[{}]:{}", address, at.port())
                              : fmt::format("{}:{}", address, at.port());
}

/// A UUID of 32 random hexadecimal digits (RFC 4122, version 4).
std::string uuid_from(const std::string& digits) {
  return fmt::format("{}-{}-4{}-8{}-{}", digits.substr(0, 8), digits.substr(8, 4), digits.substr(13, 3),
                     digits.substr(17, 3), digits.substr(20, 12));
}

class Service {
 public:
  Service(const ServeOptions& options, const StateFolder& state)
      : state_(state),
        keys_(state.path() / "keys.json"),
        preferences_(state.path() / "preferences.json"),
        daemon_(loop_, options.daemon),
        api_(daemon_),
        server_(loop_, checked_endpoint(options), api_),
        signals_(loop_),
        signal_rules_(signals_),
        watchdog_(loop_) {
    const auto at = server_.endpoint();
    server_.listen_in(state_.path(), "socket");
    AccessRules rules;
    rules.cookie = fmt::format("unicursal-{}", at.port());
    if (!options.no_token) {
      rules.token = state_.secret("token");
      rules.metrics_token = state_.secret("metrics-token");
    }
    std::vector<std::string> names = options.names;
    if (options.lan) {
      const std::vector<std::string> own = own_names();
      names.insert(names.end(), own.begin(), own.end());
      rules.present_hosts = [port = at.port()] { return own_hosts(port); };
    }
    rules.hosts = hosts_for(at.address().to_string(), at.port(), names);
    api_.on_renewal([this] { return renew_tokens(); });
    api_.set_identity(uuid_from(state_.secret("identity")));
    api_.set_keys(keys_, [this](std::uint64_t except) { server_.disconnect_network(except); });
    api_.set_preferences_of(preferences_);
    api_.set_page(Page(options.web_folder));
    api_.set_rules(std::move(rules));
    address_ = words(at);
    state_.write_address(address_);
    shown_address_ = options.lan && at.address().is_unspecified() ? reachable_address(at.port()) : address_;
  }

  void run(const std::function<void(const std::string&)>& ready) {
    await_signal();
    show_life();
    notify_service("READY=1\nSTATUS=idle");
    ready(shown_address_);
    loop_.run();
    // The clients of event streams still get their close frames.
    loop_.restart();
    const auto end = std::chrono::steady_clock::now() + farewell;
    while (!server_.deserted() && std::chrono::steady_clock::now() < end) loop_.run_one_for(farewell / 10);
  }

 private:
  void await_signal() {
    signals_.async_wait([this](const asio::error_code& error, int signal) {
      if (error) return;
      if (stopping_ && !PrintSignals::counts_again(signal)) return await_signal();
      log_line(fmt::format("signal {}: the daemon ends{}", signal,
                           daemon_.printing() ? ", when its printer is parked and cools" : ""));
      notify_service(daemon_.printing() ? "STOPPING=1\nSTATUS=parking and cooling"
                                        : "STOPPING=1\nSTATUS=ending");
      if (stopping_ && !daemon_.printing()) return end();
      stopping_ = true;
      ask_for_time();
      await_signal();
      daemon_.shut_down([this] { end(); });
    });
  }

  void end() {
    signals_.cancel();
    watchdog_.cancel();
    server_.stop();
    loop_.stop();
  }

  /// Whoever knows the old tokens is let go.
  Api::Tokens renew_tokens() {
    Api::Tokens tokens{state_.renewed("token"), state_.renewed("metrics-token")};
    server_.disconnect_network();
    return tokens;
  }

  /// Runs on the loop, so that systemd notices if the loop hangs.
  void show_life() {
    const auto watched = watchdog_interval();
    watchdog_.expires_after(watched.value_or(parking_time / 4));
    watchdog_.async_wait([this, watched](const asio::error_code& cut) {
      if (cut) return;
      if (watched) notify_service("WATCHDOG=1");
      ask_for_time();
      show_life();
    });
  }

  /// Only for a printer that is being parked and cooled; everything else ends soon by itself.
  void ask_for_time() {
    if (stopping_ && daemon_.printing())
      notify_service(fmt::format("EXTEND_TIMEOUT_USEC={}", parking_time.count()));
  }

  const StateFolder& state_;
  asio::io_context loop_{1};
  Keys keys_;
  Preferences preferences_;
  Daemon daemon_;
  Api api_;
  HttpServer server_;
  asio::signal_set signals_;
  const PrintSignals signal_rules_;
  asio::steady_timer watchdog_;
  std::string address_, shown_address_;
  bool stopping_ = false;
};

/// A thread that is inside a library's long call cannot be ended. When no print is left, the process does not
/// wait for it longer than this.
class HurriedEnd {
 public:
  explicit HurriedEnd(const StateFolder& state) : state_(state) {}
  void begin() {
    thread_ = std::jthread([this](const std::stop_token& over) {
      std::unique_lock lock(mutex_);
      if (ended_.wait_for(lock, over, longest_end, [&over] { return over.stop_requested(); })) return;
      state_.remove_address();
      std::_Exit(0);
    });
  }

 private:
  const StateFolder& state_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread thread_;
};

}  // namespace

void serve(const ServeOptions& options, const std::function<void(const std::string&)>& ready) {
  checked_endpoint(options);
  const StateFolder state(options.daemon.state);
  HurriedEnd end(state);
  Service service(options, state);
  service.run(ready);
  end.begin();
}

}  // namespace unicursal::host
