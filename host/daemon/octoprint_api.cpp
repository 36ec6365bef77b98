// The requests of OctoPrint's API that the daemon answers. Status codes are those of its documentation
// (docs/api and docs/bundledplugins/appkeys.rst) and of src/octoprint/server/api, except that a missing key
// is 401, as in the rest of the daemon's API. Keys of a request that are not known here are left aside.
#include <fmt/format.h>

#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/octoprint.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/upload_taker.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::string_view local_path = "/api/files/local/", poll_path = "/plugin/appkeys/request/";

Response no_content() {
  Response response;
  response.status = 204;
  return response;
}

std::string name_in(const Request& request) {
  return request.path.substr(local_path.size());
}

}  // namespace

// ---- who and what this is

asio::awaitable<Response> Api::octo_version(Request) {
  co_return plain_reply(octo::version());
}

asio::awaitable<Response> Api::octo_server(Request) {
  co_return plain_reply(octo::server());
}

/// A client that has a key asks who it is (`passive`). Passwords do not exist.
asio::awaitable<Response> Api::octo_login(Request request) {
  const json asked = read_object(request);
  if (asked.contains("user") || asked.contains("pass"))
    throw HttpError(403, "users and passwords do not exist here; send a key, which `unicursal keys` makes");
  const Visitor visitor = check_access(request, rules_);
  json body = octo::user(visitor);
  body.update({{"active", true},
               {"admin", false},
               {"user", true},
               {"apikey", nullptr},
               {"needs", {{"role", {"user_access"}}, {"group", {"users"}}}},
               {"roles", json::array({"user"})},
               {"settings", json::object()},
               {"session", sessions_.open()},
               {"_login_mechanism", "apikey"},
               {"_is_external_client", true}});
  co_return plain_reply(body);
}

asio::awaitable<Response> Api::octo_user(Request request) {
  co_return plain_reply(octo::user(check_access(request, rules_)));
}

asio::awaitable<Response> Api::octo_settings(Request) {
  co_return plain_reply(octo::settings(daemon_.printer().value("name", ""), identity_));
}

asio::awaitable<Response> Api::octo_profiles(Request request) {
  co_return plain_reply(octo::profiles(daemon_.profile(), octo::address(request)));
}

asio::awaitable<Response> Api::octo_connection(Request) {
  co_return plain_reply(octo::connection(daemon_.status(), daemon_.printer(), daemon_.port_exists()));
}

/// During a print the port is open anyway. Without a profile there is nothing to open it with.
asio::awaitable<Response> Api::octo_connect(Request request) {
  const json body = read_object(request);
  const std::string command = text_in(body, "command");
  if (command == "connect") {
    const std::string port = text_in(body, "port");
    if (!port.empty() && port != "AUTO" && port != daemon_.printer().value("port", ""))
      throw HttpError(400, "the daemon has one port; choose another with `unicursal serve --port`");
    if (!daemon_.port_exists())
      throw HttpError(412, "the printer's port is not there: plug the printer in and switch it on");
    if (!daemon_.busy() && daemon_.whole_profile()) daemon_.connect_printer({});
  } else if (command == "disconnect") {
    if (daemon_.busy()) throw HttpError(409, "a print is going on; cancel it first");
    daemon_.disconnect_printer();
  } else {
    throw HttpError(400, "command is \"connect\" or \"disconnect\"");
  }
  co_return no_content();
}

// ---- heat and speed

asio::awaitable<Response> Api::octo_tool(Request) {
  co_return plain_reply(octo::heaters(daemon_.status(), "tool0"));
}

asio::awaitable<Response> Api::octo_bed(Request) {
  co_return plain_reply(octo::heaters(daemon_.status(), "bed"));
}

asio::awaitable<Response> Api::octo_set_tool(Request request) {
  const json body = read_object(request);
  const std::string command = text_in(body, "command");
  if (command == "target") {
    const json targets = body.value("targets", json());
    if (!targets.is_object() || targets.size() != 1 || !targets.contains("tool0"))
      throw HttpError(400, "targets is {\"tool0\": 210}: there is one nozzle, however many feeders");
    const double target = octo::temperature(targets["tool0"]);
    if (daemon_.busy())
      obeyed(daemon_.session().set_nozzle(target));
    else
      daemon_.idle().heat(target, std::nullopt);
  } else if (command == "flowrate") {
    obeyed(daemon_.session().set_flow(octo::percent(body.value("factor", json()))));
  } else if (command == "select") {
    if (text_in(body, "tool") != "tool0")
      throw HttpError(400, "tool is \"tool0\": there is one nozzle, however many feeders");
  } else if (command == "extrude") {
    if (daemon_.busy()) throw HttpError(409, "plastic is not extruded by hand during a print");
    daemon_.idle().extrude(octo::millimetres(body, "amount"));
  } else if (command == "offset") {
    throw HttpError(409, "targets have no offset here; set the target itself");
  } else {
    throw HttpError(400, "command is \"target\", \"flowrate\" or \"select\"");
  }
  co_return no_content();
}

asio::awaitable<Response> Api::octo_set_bed(Request request) {
  const json body = read_object(request);
  const std::string command = text_in(body, "command");
  if (command == "offset") throw HttpError(409, "targets have no offset here; set the target itself");
  if (command != "target") throw HttpError(400, "command is \"target\"");
  const double target = octo::temperature(body.value("target", json()));
  if (daemon_.busy())
    obeyed(daemon_.session().set_bed(target));
  else
    daemon_.idle().heat(std::nullopt, target);
  co_return no_content();
}

asio::awaitable<Response> Api::octo_move(Request request) {
  const json body = read_object(request);
  const std::string command = text_in(body, "command");
  if ((command == "jog" || command == "home") && daemon_.busy())
    throw HttpError(409, "a print is going on, which moves the head itself");
  if (command == "home") {
    daemon_.idle().home(axes_of(body));
    co_return no_content();
  }
  if (command == "jog") {
    daemon_.idle().move(octo::jog(body, daemon_.idle().status().at));
    co_return no_content();
  }
  if (command != "feedrate") throw HttpError(400, "command is \"feedrate\"");
  obeyed(daemon_.session().set_speed(octo::percent(body.value("factor", json()))));
  co_return no_content();
}

/// M112 is known; other commands are not passed on, since a print would not know of them.
asio::awaitable<Response> Api::octo_send(Request request) {
  const json body = read_object(request);
  if (text_in(body, "command") != "M112")
    throw HttpError(409,
                    "commands are not passed on to the printer, but M112 is: it stops the print at once");
  daemon_.stop_at_once();
  co_return no_content();
}

// ---- the print

asio::awaitable<Response> Api::octo_job(Request) {
  co_return plain_reply(octo::job(daemon_.status(), daemon_.queue().next(), daemon_.port_exists()));
}

asio::awaitable<Response> Api::octo_steer(Request request) {
  const json body = read_object(request);
  const std::string command = text_in(body, "command");
  if (command == "start") {
    daemon_.start(std::nullopt);
  } else if (command == "cancel") {
    daemon_.cancel("the user has stopped it");
  } else if (command == "restart") {
    throw HttpError(409, "a print is not restarted here; cancel it, queue its file and start that");
  } else if (command == "pause") {
    const std::string asked = text_in(body, "action");
    const std::string state = octo::state_text(daemon_.status(), true);
    const bool held = state == "Paused" || state == "Pausing";
    const std::string action = asked.empty() || asked == "toggle" ? (held ? "resume" : "pause") : asked;
    if (action != "pause" && action != "resume")
      throw HttpError(400, "action is \"pause\", \"resume\" or \"toggle\"");
    Session& session = daemon_.session();
    if (action == "pause" && !held) obeyed(session.pause());
    if (action == "resume" && held) obeyed(session.resume());
  } else {
    throw HttpError(400, "command is \"start\", \"cancel\" or \"pause\"");
  }
  co_return no_content();
}

// ---- files

asio::awaitable<Response> Api::octo_files(Request request) {
  co_return plain_reply(
      octo::files(co_await daemon_.local_files(), daemon_.files().free_bytes(), octo::address(request)));
}

asio::awaitable<Response> Api::octo_file(Request request) {
  co_return plain_reply(octo::file(co_await daemon_.local_file(name_in(request)), octo::address(request)));
}

/// A file that is sent to be printed or selected is queued; another one is kept only. A file that cannot be
/// queued is not kept either.
asio::awaitable<Response> Api::octo_upload(Request request) {
  auto& taker = static_cast<UploadTaker&>(*request.taker);
  UploadTaker::Upload upload = co_await taker.finish();
  const std::string job = co_await daemon_.adopt_upload(upload.draft, upload.file);
  log_line(fmt::format("{}: {} bytes from {}", job, upload.draft->size(),
                       request.by_socket ? "this computer" : request.peer));
  bool started = false;
  if (upload.print || upload.select) {
    std::optional<HttpError> refusal;
    try {
      const std::uint64_t id = co_await daemon_.add(job, std::nullopt, upload.print);
      const QueuedJob* queued = daemon_.queue().find(id);
      started = queued && queued->state != QueuedJob::State::queued;
    } catch (const Refused& refused) {
      refusal = http_error(refused);
    }
    if (refusal) {
      co_await daemon_.remove_upload(JobFiles::upload_of(job));
      throw HttpError(*refusal);
    }
  }
  const std::string name = local_name(job).value_or(job), address = octo::address(request);
  const LocalFile kept{name, job, upload.draft->size(), 0};
  json entry = octo::file(kept, address);
  entry.erase("date");
  Response response = plain_reply({{"files", {{"local", entry}}},
                                   {"done", true},
                                   {"effectiveSelect", upload.print || upload.select},
                                   {"effectivePrint", started}},
                                  201);
  response.headers.emplace_back("Location", entry["refs"]["resource"].get<std::string>());
  co_return response;
}

/// "select" queues the file. With "print" it is also sent to be printed, as an upload would be.
asio::awaitable<Response> Api::octo_select(Request request) {
  const json body = read_object(request);
  if (text_in(body, "command") != "select")
    throw HttpError(400, "command is \"select\"; other commands of files are not known here");
  const LocalFile file = co_await daemon_.local_file(name_in(request));
  co_await daemon_.add(file.job, std::nullopt, yes(body, "print"));
  co_return no_content();
}

asio::awaitable<Response> Api::octo_delete(Request request) {
  const LocalFile file = co_await daemon_.local_file(name_in(request));
  if (!JobFiles::is_upload(file.job))
    throw HttpError(403, "that file is in a folder of the daemon's user; only uploads can be removed");
  co_await daemon_.remove_upload(JobFiles::upload_of(file.job));
  co_return no_content();
}

// ---- keys

asio::awaitable<Response> Api::octo_probe_keys(Request) {
  keys();
  co_return no_content();
}

asio::awaitable<Response> Api::octo_request_key(Request request) {
  const json body = read_object(request);
  const std::string app = text_in(body, "app");
  if (app.empty()) throw HttpError(400, "app is missing: the name of the program that asks for a key");
  const std::string ticket = keys().request(app, request.peer);
  for (const KeyRequest& one : keys().requests()) {
    if (one.ticket == ticket)
      log_line(fmt::format("\"{}\" at {} asks for a key: `unicursal keys --grant {}` grants it", one.name,
                           one.peer, one.id));
  }
  Response response = plain_reply({{"app_token", ticket}}, 201);
  response.headers.emplace_back("Location", octo::address(request) + std::string(poll_path) + ticket);
  co_return response;
}

asio::awaitable<Response> Api::octo_poll_key(Request request) {
  const Keys::Answer answer = keys().ask(request.path.substr(poll_path.size()));
  if (answer.fate == Keys::Fate::waits) co_return plain_reply({{"message", "Awaiting decision"}}, 202);
  if (answer.fate == Keys::Fate::granted) co_return plain_reply({{"api_key", answer.secret}});
  throw HttpError(404, "that was denied, or not asked about for too long; ask for a key again");
}

}  // namespace unicursal::host
