// The daemon's HTTP API (API.md): what each address does, who may use it, and how much may be sent. A part of
// OctoPrint's API is among it, for the programs that speak it (octoprint.hpp).
#pragma once

#include <functional>
#include <string>

#include "host/daemon/access.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/keys.hpp"
#include "host/daemon/octoprint_push.hpp"
#include "host/daemon/page.hpp"
#include "host/daemon/preferences.hpp"
#include "host/daemon/secret.hpp"
#include "host/daemon/wrong_tries.hpp"
#include "host/http/http_server.hpp"

namespace unicursal::host {

class Api : public HttpHandler {
 public:
  struct Route;  // route.hpp

  explicit Api(Daemon& daemon) : daemon_(daemon) {}
  /// Nobody is let in before this is called.
  void set_rules(AccessRules rules) {
    rules_ = std::move(rules);
    rules_.keys = keys_;
    rules_.logins = &logins_;
  }
  struct Tokens {
    std::string all, metrics;
  };
  /// Lets the clients of the network go, whose key may be void, but not the connection of this number.
  using Disconnect = std::function<void(std::uint64_t except)>;
  /// Keys of single programs, which must outlive this object.
  void set_keys(Keys& keys, Disconnect disconnect);
  /// They must outlive this object.
  void set_preferences_of(Preferences& preferences) { preferences_ = &preferences; }
  void set_page(Page page) { page_ = std::move(page); }
  /// A UUID that stays the same for this state folder.
  void set_identity(std::string uuid) { identity_ = std::move(uuid); }
  /// Makes new tokens, and lets those go who knew the old ones. Throws core::DataError.
  void on_renewal(std::function<Tokens()> renew) { renew_ = std::move(renew); }

  Admission admit(const RequestHead& head) override;
  asio::awaitable<Response> answer(Request request) override;
  bool wants_events(const RequestHead& head) const override;
  bool is_urgent(const RequestHead& head) const override;
  void join(std::shared_ptr<EventStream> client, const RequestHead& head, bool proven) override;

 private:
  static const Route& route_of(const RequestHead& head);
  static bool is_open(const RequestHead& head);

  asio::awaitable<Response> status(Request request);
  asio::awaitable<Response> printer(Request request);
  asio::awaitable<Response> metrics(Request request);
  asio::awaitable<Response> list_jobs(Request request);
  asio::awaitable<Response> add_job(Request request);
  asio::awaitable<Response> show_job(Request request);
  asio::awaitable<Response> remove_job(Request request);
  asio::awaitable<Response> list_files(Request request);
  asio::awaitable<Response> keep_file(Request request);
  asio::awaitable<Response> remove_upload(Request request);
  asio::awaitable<Response> start(Request request);
  asio::awaitable<Response> pause(Request request);
  asio::awaitable<Response> resume(Request request);
  asio::awaitable<Response> answer_prompt(Request request);
  asio::awaitable<Response> cancel(Request request);
  asio::awaitable<Response> stop(Request request);
  asio::awaitable<Response> set_temperature(Request request);
  asio::awaitable<Response> set_flow(Request request);
  asio::awaitable<Response> set_speed(Request request);
  asio::awaitable<Response> confirm_bed(Request request);

  asio::awaitable<Response> show_page(Request request);
  asio::awaitable<Response> show_preferences(Request request);
  asio::awaitable<Response> set_preferences(Request request);
  asio::awaitable<Response> camera(Request request);
  asio::awaitable<Response> openapi(Request request);

  // Access (access_api.cpp)
  asio::awaitable<Response> login(Request request);
  asio::awaitable<Response> logout(Request request);
  asio::awaitable<Response> decide_key(Request request);
  asio::awaitable<Response> remove_key(Request request);
  asio::awaitable<Response> add_key(Request request);
  asio::awaitable<Response> list_keys(Request request);
  asio::awaitable<Response> renew_token(Request request);

  // Of a print that goes on (live_api.cpp)
  asio::awaitable<Response> layers(Request request);
  asio::awaitable<Response> layer_path(Request request);
  asio::awaitable<Response> layer_plan(Request request);
  asio::awaitable<Response> position(Request request);
  asio::awaitable<Response> temperatures(Request request);
  asio::awaitable<Response> log(Request request);

  // dry_runs_api.cpp
  asio::awaitable<Response> list_dry_runs(Request request);
  asio::awaitable<Response> start_dry_run(Request request);
  asio::awaitable<Response> show_dry_run(Request request);
  asio::awaitable<Response> remove_dry_run(Request request);

  // Of prints that have ended, and of the queue's order (history_api.cpp)
  asio::awaitable<Response> list_history(Request request);
  asio::awaitable<Response> history_table(Request request);
  asio::awaitable<Response> show_past_print(Request request);
  asio::awaitable<Response> past_picture(Request request);
  asio::awaitable<Response> note_past_print(Request request);
  asio::awaitable<Response> remove_past_print(Request request);
  asio::awaitable<Response> print_again(Request request);
  asio::awaitable<Response> list_prints(Request request);
  asio::awaitable<Response> arrange_jobs(Request request);
  asio::awaitable<Response> copy_job(Request request);
  asio::awaitable<Response> job_picture(Request request);
  asio::awaitable<Response> resume_print(Request request);

  // Of a printer while nothing is printed (idle_api.cpp)
  nlohmann::json whole_printer() const;
  asio::awaitable<Response> connect_printer(Request request);
  asio::awaitable<Response> disconnect_printer(Request request);
  asio::awaitable<Response> heat(Request request);
  asio::awaitable<Response> home(Request request);
  asio::awaitable<Response> move_head(Request request);
  asio::awaitable<Response> set_fan(Request request);
  asio::awaitable<Response> feed(Request request);
  asio::awaitable<Response> cancel_idle(Request request);

  // Of ports, doctor and profile (profile_api.cpp)
  asio::awaitable<Response> list_ports(Request request);
  asio::awaitable<Response> examine(Request request);
  asio::awaitable<Response> show_profile(Request request);
  asio::awaitable<Response> change_profile(Request request);
  asio::awaitable<Response> list_frames(Request request);
  asio::awaitable<Response> make_profile(Request request);

  // OctoPrint's (octoprint_api.cpp)
  asio::awaitable<Response> octo_version(Request request);
  asio::awaitable<Response> octo_server(Request request);
  asio::awaitable<Response> octo_login(Request request);
  asio::awaitable<Response> octo_user(Request request);
  asio::awaitable<Response> octo_settings(Request request);
  asio::awaitable<Response> octo_profiles(Request request);
  asio::awaitable<Response> octo_connection(Request request);
  asio::awaitable<Response> octo_connect(Request request);
  asio::awaitable<Response> octo_tool(Request request);
  asio::awaitable<Response> octo_set_tool(Request request);
  asio::awaitable<Response> octo_bed(Request request);
  asio::awaitable<Response> octo_set_bed(Request request);
  asio::awaitable<Response> octo_move(Request request);
  asio::awaitable<Response> octo_send(Request request);
  asio::awaitable<Response> octo_job(Request request);
  asio::awaitable<Response> octo_steer(Request request);
  asio::awaitable<Response> octo_files(Request request);
  asio::awaitable<Response> octo_file(Request request);
  asio::awaitable<Response> octo_upload(Request request);
  asio::awaitable<Response> octo_select(Request request);
  asio::awaitable<Response> octo_delete(Request request);
  asio::awaitable<Response> octo_probe_keys(Request request);
  asio::awaitable<Response> octo_request_key(Request request);
  asio::awaitable<Response> octo_poll_key(Request request);

  Keys& keys();
  Admission let_in(const RequestHead& head);
  /// The refusal of a wrong token or key comes late.
  HttpError refusal_to(const HttpError& refused, const std::string& peer);

  Daemon& daemon_;
  AccessRules rules_{random_token(), {}, {}};
  std::function<Tokens()> renew_;
  Keys* keys_ = nullptr;
  std::string identity_;
  Page page_;
  Preferences* preferences_ = nullptr;
  PushSessions sessions_;
  Logins logins_;
  WrongTries wrong_tries_;
  Disconnect disconnect_;
};

}  // namespace unicursal::host
