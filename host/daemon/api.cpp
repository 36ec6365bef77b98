#include "host/daemon/api.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/daemon/api_body.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/metrics.hpp"
#include "host/daemon/octoprint.hpp"
#include "host/daemon/plain_name.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/route.hpp"
#include "host/daemon/upload_taker.hpp"
#include "host/engine/temperature_limits.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::uint64_t longest_json = 64 * 1024;            ///< bytes
constexpr std::uint64_t longest_request_for_key = 4 * 1024;  ///< bytes; strangers send it
constexpr std::string_view jobs_path = "/api/jobs/", files_path = "/api/files/";

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

/// "upload/file" behind /api/files/; the second is empty if there is no slash.
std::pair<std::string, std::string> names_in(const std::string& path) {
  const std::string names = path.substr(files_path.size());
  const std::size_t slash = names.find('/');
  if (slash == std::string::npos) return {names, ""};
  return {names.substr(0, slash), names.substr(slash + 1)};
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

/// Throws HttpError 404 or 405.
const Api::Route& Api::route_of(const RequestHead& head) {
  const std::string_view asked = head.method == "HEAD" ? "GET" : std::string_view(head.method);
  std::string allowed;
  for (const Route& route : Route::all()) {
    if (!route.matches(head.path)) continue;
    if (route.method == asked) return route;
    allowed += (allowed.empty() ? "" : ", ") + std::string(route.method);
    if (route.method == "GET") allowed += ", HEAD";
  }
  if (!allowed.empty()) throw HttpError::wrong_method("that cannot be done with this address", allowed);
  throw HttpError(404, "there is no such address; the API is described in API.md");
}

/// Whether strangers, too, may ask for that.
bool Api::is_open(const RequestHead& head) {
  const auto open = [&](const Route& route) { return route.open && route.matches(head.path); };
  return std::any_of(Route::all().begin(), Route::all().end(), open);
}

Admission Api::let_in(const RequestHead& head) {
  if (is_open(head)) {
    const Route& route = route_of(head);
    const bool follows = !route.handler;
    if (route.handler == &Api::show_page)
      check_host(head, rules_);  // a link of another site may lead to the page
    else if (!follows)
      check_site(head, rules_);
    return {longest_request_for_key, follows && seek_access(head, rules_), nullptr};
  }
  const Visitor visitor = check_access(head, rules_);
  const Route& route = route_of(head);
  if (visitor.right < route.right)
    throw HttpError(403, fmt::format("the key \"{}\" has the right to {} only; make another with `unicursal "
                                     "keys --new NAME --right {}`",
                                     visitor.name, name(visitor.right), name(route.right)));
  if (route.handler == &Api::octo_upload && head.method == "POST") {
    const std::string boundary = form_boundary(head.header("content-type").value_or(""));
    return {largest_form, true, std::make_shared<UploadTaker>(daemon_, boundary, head.content_length)};
  }
  if (head.method != "PUT") return {longest_json, true, nullptr};
  const auto [upload, file] = names_in(head.path);
  if (!is_plain_name(upload) || !is_plain_name(file))
    throw HttpError(400, "names of uploads hold letters, digits, dots, dashes and underscores only");
  return {largest_upload, true, nullptr};
}

Admission Api::admit(const RequestHead& head) {
  try {
    return let_in(head);
  } catch (const HttpError& refused) {
    throw refusal_to(refused, head.peer);
  }
}

bool Api::wants_events(const RequestHead& head) const {
  return !route_of(head).handler;
}

/// What makes a printer safe; it must not be locked out.
bool Api::is_urgent(const RequestHead& head) const {
  return head.path == "/api/print/stop" || head.path == "/api/print/cancel" ||
         head.path == "/api/print/pause" || head.path == "/api/printer/command" ||
         (head.path == "/api/job" && head.method == "POST");
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
    throw http_error(refused);
  } catch (const std::exception& error) {
    if (!asked.empty()) log_line(asked + ": refused: " + error.what());
    throw;
  }
}

void Api::join(std::shared_ptr<EventStream> client, const RequestHead& head, bool proven) {
  if (head.path == push_path) return push_to(*client, proven, daemon_, sessions_);
  daemon_.join(std::make_unique<StreamFollower>(std::move(client)));
}

// ---- status

asio::awaitable<Response> Api::status(Request) {
  co_return reply(daemon_.status());
}

/// With what OctoPrint's clients look for. To them, who have a key in X-Api-Key, a printer that is switched
/// off is a conflict.
asio::awaitable<Response> Api::printer(Request request) {
  json body = daemon_.printer();
  const bool there = daemon_.port_exists();
  body.update(octo::printer(daemon_.status(), there));
  const bool octoprint = request.header("x-api-key").has_value();
  if (there || !octoprint) co_return reply(std::move(body));
  body["error"] = "the printer is not connected: plug it in and switch it on";
  co_return reply(std::move(body), 409);
}

asio::awaitable<Response> Api::metrics(Request) {
  Response response;
  response.type = "text/plain; version=0.0.4";
  response.body = metrics_text(daemon_.status());
  co_return response;
}

asio::awaitable<Response> Api::show_page(Request request) {
  co_return page_.answer(request);
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
  const std::uint64_t id = co_await daemon_.add(job->get<std::string>(), layers_in(body));
  co_return reply({{"id", id}}, 201);
}

asio::awaitable<Response> Api::show_job(Request request) {
  const QueuedJob* job = daemon_.queue().find(number_behind(request.path, jobs_path));
  if (!job) throw HttpError(404, "there is no job with that number");
  co_return reply(to_json(*job));
}

asio::awaitable<Response> Api::remove_job(Request request) {
  const std::uint64_t id = number_behind(request.path, jobs_path);
  co_await daemon_.remove(id);
  co_return reply({{"removed", id}});
}

asio::awaitable<Response> Api::list_files(Request request) {
  const std::vector<std::string> names = co_await daemon_.job_names();
  json body =
      octo::files(co_await daemon_.local_files(), daemon_.files().free_bytes(), octo::address(request));
  body["jobs"] = names;
  co_return reply(std::move(body));
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

asio::awaitable<Response> Api::confirm_bed(Request request) {
  const json body = read_object(request, {"clear"});
  if (!yes(body, "clear")) throw HttpError(400, "clear is missing: say true when the bed is clear");
  daemon_.confirm_bed_clear();
  co_return reply(daemon_.status(), 202);
}

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

asio::awaitable<Response> Api::set_speed(Request request) {
  const double percent = required_number(read_object(request, {"percent"}), "percent");
  obeyed(daemon_.session().set_speed(percent));
  co_return reply(daemon_.status(), 202);
}

}  // namespace unicursal::host
