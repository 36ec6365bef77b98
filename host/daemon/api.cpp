#include "host/daemon/api.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/daemon/api_body.hpp"
#include "host/daemon/metrics.hpp"
#include "host/daemon/octoprint.hpp"
#include "host/daemon/refused.hpp"
#include "host/engine/temperature_limits.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

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

}  // namespace

// ---- status

asio::awaitable<Response> Api::status(Request) {
  co_return reply(daemon_.status());
}

/// With what OctoPrint's clients look for.
json Api::whole_printer() const {
  json body = daemon_.printer();
  body.update(octo::printer(daemon_.status(), daemon_.port_exists()));
  return body;
}

/// To OctoPrint's clients, who have a key in X-Api-Key, a printer that is switched
/// off is a conflict.
asio::awaitable<Response> Api::printer(Request request) {
  json body = whole_printer();
  const bool there = daemon_.port_exists();
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
  const auto [upload, file] = names_behind(request.path, files_path);
  co_await daemon_.keep_upload(upload, file, std::move(request.body));
  co_return reply({{"job", "upload:" + upload + "/" + file}}, 201);
}

asio::awaitable<Response> Api::remove_upload(Request request) {
  const std::string upload = names_behind(request.path, files_path).first;
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
