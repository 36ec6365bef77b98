#include "host/daemon/api.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "host/daemon/metrics.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::uint64_t longest_json = 64 * 1024;  ///< bytes
constexpr std::string_view jobs_path = "/api/jobs", files_path = "/api/files/";

struct Route {
  std::string_view method, path;  ///< a path that ends with a slash has a name behind it
};

constexpr std::array routes = {
    Route{"GET", "/api/status"},       Route{"GET", "/api/printer"},       Route{"GET", "/api/events"},
    Route{"GET", "/metrics"},          Route{"GET", "/api/jobs"},          Route{"POST", "/api/jobs"},
    Route{"GET", "/api/jobs/"},        Route{"DELETE", "/api/jobs/"},      Route{"GET", "/api/files"},
    Route{"PUT", "/api/files/"},       Route{"DELETE", "/api/files/"},     Route{"POST", "/api/print/start"},
    Route{"POST", "/api/print/pause"}, Route{"POST", "/api/print/resume"}, Route{"POST", "/api/print/cancel"},
    Route{"POST", "/api/print/stop"},  Route{"POST", "/api/temperature"},  Route{"POST", "/api/flow"},
    Route{"POST", "/api/speed"}};

bool matches(const Route& route, const std::string& path) {
  if (route.path.back() != '/') return path == route.path;
  return path.size() > route.path.size() && path.starts_with(route.path);
}

/// Throws 404 or 405.
void check_route(const RequestHead& head) {
  bool known = false;
  for (const Route& route : routes) {
    if (!matches(route, head.path)) continue;
    if (route.method == head.method) return;
    known = true;
  }
  if (known) throw HttpError(405, "that cannot be done with this address");
  throw HttpError(404, "there is no such address; the API is described in API.md");
}

Response reply(json body, int status = 200) {
  body["version"] = 1;
  Response response;
  response.status = status;
  response.body = body.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  return response;
}

/// An object with none but the known keys; an empty body is an empty object. Throws HttpError 400 or 415.
json read_object(const Request& request, std::initializer_list<const char*> keys) {
  if (request.body.empty()) return json::object();
  const std::string type = request.header("content-type").value_or("");
  if (type.substr(0, type.find(';')) != "application/json")
    throw HttpError(415, "send JSON, as Content-Type: application/json");
  const json body = json::parse(request.body, nullptr, false);
  if (!body.is_object()) throw HttpError(400, "the body is no JSON object");
  for (const auto& [key, value] : body.items()) {
    const bool known = std::any_of(keys.begin(), keys.end(), [&](const char* one) { return key == one; });
    if (!known) throw HttpError(400, "a key is not known here: \"" + key.substr(0, 40) + "\"");
  }
  return body;
}

std::optional<double> number(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) return std::nullopt;
  if (!found->is_number()) throw HttpError(400, fmt::format("{} is no number", key));
  return found->get<double>();
}

double required_number(const json& body, const char* key) {
  if (const auto value = number(body, key)) return *value;
  throw HttpError(400, fmt::format("{} is missing", key));
}

std::optional<std::uint64_t> whole_number(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) return std::nullopt;
  if (!found->is_number_unsigned()) throw HttpError(400, fmt::format("{} is no whole number", key));
  return found->get<std::uint64_t>();
}

std::optional<LayerRange> layers_of(const json& body) {
  const auto found = body.find("layers");
  if (found == body.end()) return std::nullopt;
  if (!found->is_array() || found->size() != 2 || !found->at(0).is_number_unsigned() ||
      !found->at(1).is_number_unsigned())
    throw HttpError(400, "layers is [first, last], counted from 0");
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

/// "upload/file" behind /api/files/; the second is empty where there is none.
std::pair<std::string, std::string> names_in(const std::string& path) {
  const std::string names = path.substr(files_path.size());
  const std::size_t slash = names.find('/');
  if (slash == std::string::npos) return {names, ""};
  return {names.substr(0, slash), names.substr(slash + 1)};
}

}  // namespace

std::uint64_t Api::admit(const RequestHead& head) {
  check_access(head, rules_);
  check_route(head);
  if (head.method == "PUT") {
    const auto [upload, file] = names_in(head.path);
    if (!is_plain_name(upload) || !is_plain_name(file))
      throw HttpError(400, "names of uploads hold letters, digits, dots, dashes and underscores only");
    return largest_upload;
  }
  return longest_json;
}

bool Api::wants_events(const RequestHead& head) const {
  return head.path == "/api/events";
}

asio::awaitable<Response> Api::answer(Request request) {
  const std::string& path = request.path;
  if (path == "/api/status") co_return reply(daemon_.status());
  if (path == "/api/printer") co_return reply(daemon_.printer());
  if (path == "/metrics") {
    Response response;
    response.type = "text/plain; version=0.0.4";
    response.body = metrics_text(daemon_.status());
    co_return response;
  }
  if (path.starts_with(jobs_path)) co_return co_await answer_jobs(request);
  if (path.starts_with("/api/files")) co_return co_await answer_files(std::move(request));
  co_return answer_print(request);
}

asio::awaitable<Response> Api::answer_jobs(const Request& request) {
  if (request.path != jobs_path) {
    const std::uint64_t id = id_in(request.path);
    if (request.method == "DELETE") {
      co_await daemon_.remove(id);
      co_return reply({{"removed", id}});
    }
    const QueuedJob* job = daemon_.queue().find(id);
    if (!job) throw HttpError(404, "there is no job of that number");
    co_return reply(to_json(*job));
  }
  if (request.method == "POST") {
    const json body = read_object(request, {"job", "layers"});
    const auto job = body.find("job");
    if (job == body.end() || !job->is_string()) throw HttpError(400, "job is missing: the name of the job");
    const std::uint64_t id = co_await daemon_.add(job->get<std::string>(), layers_of(body));
    co_return reply({{"id", id}}, 201);
  }
  json jobs = json::array();
  for (const QueuedJob& job : daemon_.queue().jobs()) jobs.push_back(to_json(job));
  co_return reply({{"jobs", jobs}});
}

asio::awaitable<Response> Api::answer_files(Request request) {
  if (request.method == "GET") {
    const std::vector<std::string> names = co_await daemon_.job_names();
    co_return reply({{"jobs", names}});
  }
  const auto [upload, file] = names_in(request.path);
  if (request.method == "PUT") {
    co_await daemon_.keep_upload(upload, file, std::move(request.body));
    co_return reply({{"job", "upload:" + upload + "/" + file}}, 201);
  }
  co_await daemon_.remove_upload(upload);
  co_return reply({{"removed", upload}});
}

Response Api::answer_print(const Request& request) {
  const std::string& path = request.path;
  if (path == "/api/print/start") {
    const json body = read_object(request, {"id"});
    return reply({{"id", daemon_.start(whole_number(body, "id"))}}, 202);
  }
  if (path == "/api/temperature") {
    const json body = read_object(request, {"nozzle_c", "bed_c"});
    const auto nozzle = number(body, "nozzle_c"), bed = number(body, "bed_c");
    if (!nozzle && !bed) throw HttpError(400, "nozzle_c or bed_c is missing");
    if (nozzle) obeyed(daemon_.session().set_nozzle(*nozzle));
    if (bed) obeyed(daemon_.session().set_bed(*bed));
  } else if (path == "/api/flow" || path == "/api/speed") {
    const double percent = required_number(read_object(request, {"percent"}), "percent");
    obeyed(path == "/api/flow" ? daemon_.session().set_flow(percent) : daemon_.session().set_speed(percent));
  } else {
    read_object(request, {});
    if (path == "/api/print/pause") obeyed(daemon_.session().pause());
    if (path == "/api/print/resume") obeyed(daemon_.session().resume());
    if (path == "/api/print/cancel") daemon_.cancel("the user has stopped it");
    if (path == "/api/print/stop") daemon_.stop_at_once();
  }
  return reply(daemon_.status(), 202);
}

}  // namespace unicursal::host
