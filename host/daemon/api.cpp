#include "host/daemon/api.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/text/wording.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/metrics.hpp"
#include "host/daemon/refused.hpp"
#include "host/engine/temperature_limits.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::uint64_t longest_json = 64 * 1024;  ///< bytes
constexpr std::string_view jobs_path = "/api/jobs", files_path = "/api/files/";

Response reply(json body, int status = 200) {
  body["version"] = 1;
  Response response;
  response.status = status;
  response.body = body.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  return response;
}

/// Reads an object that has known keys only; an empty body is an empty object. Throws HttpError 400 or 415.
json read_object(const Request& request, std::initializer_list<const char*> keys) {
  if (request.body.empty()) return json::object();
  std::string type = core::lower(request.header("content-type").value_or(""));
  type.resize(std::min(type.find(';'), type.size()));  // parameters follow (RFC 9110, 8.3.1)
  type.resize(type.find_last_not_of(" \t") + 1);
  if (type != "application/json") throw HttpError(415, "send JSON, as Content-Type: application/json");
  const json body = json::parse(request.body, nullptr, false);
  if (!body.is_object()) throw HttpError(400, "the body is not a JSON object");
  for (const auto& [key, value] : body.items()) {
    const bool known = std::any_of(keys.begin(), keys.end(), [&](const char* one) { return key == one; });
    if (!known) throw HttpError(400, "a key is not known here: \"" + key.substr(0, 40) + "\"");
  }
  return body;
}

std::optional<double> number(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) return std::nullopt;
  if (!found->is_number()) throw HttpError(400, fmt::format("{} is not a number", key));
  return found->get<double>();
}

double required_number(const json& body, const char* key) {
  if (const auto value = number(body, key)) return *value;
  throw HttpError(400, fmt::format("{} is missing", key));
}

std::optional<std::uint64_t> whole_number(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) return std::nullopt;
  if (!found->is_number_unsigned()) throw HttpError(400, fmt::format("{} is not a whole number", key));
  return found->get<std::uint64_t>();
}

bool yes(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) return false;
  if (!found->is_boolean()) throw HttpError(400, fmt::format("{} is not true or false", key));
  return found->get<bool>();
}

std::optional<LayerRange> layers_of(const json& body) {
  const auto found = body.find("layers");
  if (found == body.end()) return std::nullopt;
  if (!found->is_array() || found->size() != 2 || !found->at(0).is_number_unsigned() ||
      !found->at(1).is_number_unsigned())
    throw HttpError(400, "layers is [first, last], counted from 0");
  if (found->at(0).get<std::size_t>() > found->at(1).get<std::size_t>())
    throw HttpError(422, "layers is [first, last]; the first is behind the last");
  return LayerRange{found->at(0).get<std::size_t>(), found->at(1).get<std::size_t>()};
}

std::uint64_t id_in(const std::string& path) {
  std::uint64_t id = 0;
  const char* end = path.data() + path.size();
  const auto [stop, error] = std::from_chars(path.data() + jobs_path.size() + 1, end, id);
  if (error != std::errc() || stop != end) throw HttpError(404, "a job is named by its number");
  return id;
}

void obeyed(const Refusal& refusal) {
  if (refusal) throw HttpError(409, *refusal);
}

/// "upload/file" behind /api/files/; the second is empty if there is no slash.
std::pair<std::string, std::string> names_in(const std::string& path) {
  const std::string names = path.substr(files_path.size());
  const std::size_t slash = names.find('/');
  if (slash == std::string::npos) return {names, ""};
  return {names.substr(0, slash), names.substr(slash + 1)};
}

/// The HTTP status of a refusal.
int status_of(Refused::Why why) {
  switch (why) {
    case Refused::Why::bad_name:
      return 400;
    case Refused::Why::not_found:
      return 404;
    case Refused::Why::conflict:
      return 409;
    case Refused::Why::bad_job:
      return 422;
    case Refused::Why::no_room:
      break;
  }
  return 507;
}

/// A WebSocket that follows the daemon.
class StreamFollower final : public Follower {
 public:
  explicit StreamFollower(std::shared_ptr<EventStream> stream) : stream_(std::move(stream)) {}
  bool open() const override { return stream_->open(); }
  void send(const std::string& event) override { stream_->send(event); }

 private:
  std::shared_ptr<EventStream> stream_;
};

}  // namespace

struct Api::Route {
  std::string_view method, path;  ///< a path that ends with a slash is followed by a name
  asio::awaitable<Response> (Api::*handler)(Request request);  ///< null: the stream of events

  bool matches(const std::string& asked) const {
    if (path.back() != '/') return asked == path;
    return asked.size() > path.size() && asked.starts_with(path);
  }
};

/// Throws HttpError 404 or 405.
const Api::Route& Api::route_of(const RequestHead& head) {
  static constexpr Route routes[] = {
      {"GET", "/api/status", &Api::status},
      {"GET", "/api/printer", &Api::printer},
      {"GET", "/api/events", nullptr},
      {"GET", "/metrics", &Api::metrics},
      {"GET", "/api/jobs", &Api::list_jobs},
      {"POST", "/api/jobs", &Api::add_job},
      {"GET", "/api/jobs/", &Api::show_job},
      {"DELETE", "/api/jobs/", &Api::remove_job},
      {"GET", "/api/files", &Api::list_files},
      {"PUT", "/api/files/", &Api::keep_file},
      {"DELETE", "/api/files/", &Api::remove_upload},
      {"POST", "/api/print/start", &Api::start},
      {"POST", "/api/print/pause", &Api::pause},
      {"POST", "/api/print/resume", &Api::resume},
      {"POST", "/api/print/answer", &Api::answer_prompt},
      {"POST", "/api/print/cancel", &Api::cancel},
      {"POST", "/api/print/stop", &Api::stop},
      {"POST", "/api/temperature", &Api::set_temperature},
      {"POST", "/api/flow", &Api::set_flow},
      {"POST", "/api/speed", &Api::set_speed},
      {"POST", "/api/token/renew", &Api::renew_token},
  };
  const std::string_view asked = head.method == "HEAD" ? "GET" : std::string_view(head.method);
  std::string allowed;
  for (const Route& route : routes) {
    if (!route.matches(head.path)) continue;
    if (route.method == asked) return route;
    allowed += (allowed.empty() ? "" : ", ") + std::string(route.method);
    if (route.method == "GET") allowed += ", HEAD";
  }
  if (!allowed.empty()) throw HttpError(405, "that cannot be done with this address", allowed);
  throw HttpError(404, "there is no such address; the API is described in API.md");
}

std::uint64_t Api::admit(const RequestHead& head) {
  check_access(head, rules_);
  route_of(head);
  if (head.method == "PUT") {
    const auto [upload, file] = names_in(head.path);
    if (!is_plain_name(upload) || !is_plain_name(file))
      throw HttpError(400, "names of uploads hold letters, digits, dots, dashes and underscores only");
    return largest_upload;
  }
  return longest_json;
}

bool Api::wants_events(const RequestHead& head) const {
  return !route_of(head).handler;
}

/// What makes a printer safe; it must not be locked out.
bool Api::is_urgent(const RequestHead& head) const {
  return head.path == "/api/print/stop" || head.path == "/api/print/cancel" ||
         head.path == "/api/print/pause";
}

asio::awaitable<Response> Api::answer(Request request) {
  const Route& route = route_of(request);
  const std::string asked = route.method == "GET" ? "" : request.method + " " + request.path;
  try {
    Response response = co_await (this->*route.handler)(std::move(request));
    if (!asked.empty()) log_line(asked + ": done");
    co_return response;
  } catch (const Refused& refused) {
    if (!asked.empty()) log_line(asked + ": refused: " + refused.what());
    throw HttpError(status_of(refused.why()), refused.what());
  } catch (const std::exception& error) {
    if (!asked.empty()) log_line(asked + ": refused: " + error.what());
    throw;
  }
}

void Api::join(std::shared_ptr<EventStream> client) {
  daemon_.join(std::make_unique<StreamFollower>(std::move(client)));
}

// ---- status

asio::awaitable<Response> Api::status(Request) {
  co_return reply(daemon_.status());
}

asio::awaitable<Response> Api::printer(Request) {
  co_return reply(daemon_.printer());
}

asio::awaitable<Response> Api::metrics(Request) {
  Response response;
  response.type = "text/plain; version=0.0.4";
  response.body = metrics_text(daemon_.status());
  co_return response;
}

// ---- the queue and the files

asio::awaitable<Response> Api::list_jobs(Request) {
  json jobs = json::array();
  for (const QueuedJob& job : daemon_.queue().jobs()) jobs.push_back(to_json(job));
  co_return reply({{"jobs", jobs}});
}

asio::awaitable<Response> Api::add_job(Request request) {
  const json body = read_object(request, {"job", "layers"});
  const auto job = body.find("job");
  if (job == body.end() || !job->is_string()) throw HttpError(400, "job is missing: the name of the job");
  const std::uint64_t id = co_await daemon_.add(job->get<std::string>(), layers_of(body));
  co_return reply({{"id", id}}, 201);
}

asio::awaitable<Response> Api::show_job(Request request) {
  const QueuedJob* job = daemon_.queue().find(id_in(request.path));
  if (!job) throw HttpError(404, "there is no job with that number");
  co_return reply(to_json(*job));
}

asio::awaitable<Response> Api::remove_job(Request request) {
  const std::uint64_t id = id_in(request.path);
  co_await daemon_.remove(id);
  co_return reply({{"removed", id}});
}

asio::awaitable<Response> Api::list_files(Request) {
  const std::vector<std::string> names = co_await daemon_.job_names();
  co_return reply({{"jobs", names}});
}

asio::awaitable<Response> Api::keep_file(Request request) {
  const auto [upload, file] = names_in(request.path);
  co_await daemon_.keep_upload(upload, file, std::move(request.body));
  co_return reply({{"job", "upload:" + upload + "/" + file}}, 201);
}

asio::awaitable<Response> Api::remove_upload(Request request) {
  const std::string upload = names_in(request.path).first;
  co_await daemon_.remove_upload(upload);
  co_return reply({{"removed", upload}});
}

// ---- the print

asio::awaitable<Response> Api::start(Request request) {
  const json body = read_object(request, {"id", "bed_clear"});
  co_return reply({{"id", daemon_.start(whole_number(body, "id"), yes(body, "bed_clear"))}}, 202);
}

asio::awaitable<Response> Api::pause(Request request) {
  read_object(request, {});
  obeyed(daemon_.session().pause());
  co_return reply(daemon_.status(), 202);
}

asio::awaitable<Response> Api::resume(Request request) {
  const json body = read_object(request, {"sure"});
  if (daemon_.busy())
    obeyed(daemon_.session().resume());
  else
    daemon_.continue_interrupted(yes(body, "sure"));
  co_return reply(daemon_.status(), 202);
}

asio::awaitable<Response> Api::answer_prompt(Request request) {
  const auto button = whole_number(read_object(request, {"button"}), "button");
  if (!button) throw HttpError(400, "button is missing");
  constexpr std::uint64_t most = 1000;  // more than any question has
  obeyed(daemon_.session().answer(std::min(*button, most)));
  co_return reply(daemon_.status(), 202);
}

asio::awaitable<Response> Api::cancel(Request request) {
  read_object(request, {});
  daemon_.cancel("the user has stopped it");
  co_return reply(daemon_.status(), 202);
}

asio::awaitable<Response> Api::stop(Request request) {
  read_object(request, {});
  daemon_.stop_at_once();
  co_return reply(daemon_.status(), 202);
}

asio::awaitable<Response> Api::set_temperature(Request request) {
  const json body = read_object(request, {"nozzle_c", "bed_c"});
  const auto nozzle = number(body, "nozzle_c"), bed = number(body, "bed_c");
  if (!nozzle && !bed) throw HttpError(400, "nozzle_c or bed_c is missing");
  Session& session = daemon_.session();
  // A bed that will be refused is refused before the nozzle is set: both are obeyed, or neither.
  if (bed && (*bed < 0 || *bed > hottest_bed)) obeyed(session.set_bed(*bed));
  if (nozzle) obeyed(session.set_nozzle(*nozzle));
  if (bed) obeyed(session.set_bed(*bed));
  co_return reply(daemon_.status(), 202);
}

asio::awaitable<Response> Api::set_flow(Request request) {
  const double percent = required_number(read_object(request, {"percent"}), "percent");
  obeyed(daemon_.session().set_flow(percent));
  co_return reply(daemon_.status(), 202);
}

/// Only the owner of the state folder may shut others out; the new token does not cross the network.
asio::awaitable<Response> Api::renew_token(Request request) {
  read_object(request, {});
  if (!request.by_socket)
    throw HttpError(403, "the token is renewed through the socket in the state folder only");
  if (!rules_.token) throw HttpError(409, "this daemon asks for no token");
  Tokens tokens = renew_();
  rules_.token = std::move(tokens.all);
  rules_.metrics_token = std::move(tokens.metrics);
  co_return reply(json::object());
}

asio::awaitable<Response> Api::set_speed(Request request) {
  const double percent = required_number(read_object(request, {"percent"}), "percent");
  obeyed(daemon_.session().set_speed(percent));
  co_return reply(daemon_.status(), 202);
}

}  // namespace unicursal::host
