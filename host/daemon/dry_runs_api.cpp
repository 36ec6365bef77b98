// Dry runs for a client: started, listed, shown and removed.
#include <algorithm>

#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"
#include "host/daemon/dry_runs.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::string_view dry_runs_path = "/api/dry-runs/";
/// The page of a dry run runs the script beside it, and pages of this daemon may show it in a frame.
constexpr const char* viewer_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; frame-ancestors 'self'; "
    "base-uri 'none'; form-action 'none'";
constexpr const char* kept_an_hour = "private, max-age=3600";  // pictures; numbers are never given twice

std::string ending_type(const std::string& name) {
  const auto kind = std::find_if(shown_files.begin(), shown_files.end(),
                                 [&](const auto& one) { return name.ends_with(one.first); });
  return kind == shown_files.end() ? "application/octet-stream" : kind->second;
}

}  // namespace

asio::awaitable<Response> Api::list_dry_runs(Request) {
  json all = json::array();
  for (const DryRunRecord& run : daemon_.dry_runs().all()) all.push_back(to_json(run));
  co_return reply({{"dry_runs", all}});
}

asio::awaitable<Response> Api::start_dry_run(Request request) {
  const json body = read_object(request, {"job", "layers"});
  const auto job = body.find("job");
  if (job == body.end() || !job->is_string()) throw HttpError(400, "job is missing: the name of the job");
  const std::uint64_t id = co_await daemon_.try_job(job->get<std::string>(), layers_in(body));
  co_return reply({{"id", id}}, 201);
}

/// "17" is the run itself, "17/report.json" one of its files.
asio::awaitable<Response> Api::show_dry_run(Request request) {
  const std::string behind = request.path.substr(dry_runs_path.size());
  const std::size_t slash = std::min(behind.find('/'), behind.size());
  const std::uint64_t id = number_behind(behind.substr(0, slash), "");
  if (slash == behind.size()) {
    const DryRunRecord* run = daemon_.dry_runs().find(id);
    if (!run) throw HttpError(404, "no dry run has that number");
    co_return reply(to_json(*run));
  }
  const std::string name = behind.substr(slash + 1);
  Response response;
  response.body = co_await daemon_.dry_runs().file(id, name);
  response.type = ending_type(name);
  response.headers = {{"Content-Security-Policy", viewer_policy}, {"Referrer-Policy", "no-referrer"}};
  if (response.type == "image/png") response.headers.emplace_back("Cache-Control", kept_an_hour);
  co_return response;
}

asio::awaitable<Response> Api::remove_dry_run(Request request) {
  const std::uint64_t id = number_behind(request.path, dry_runs_path);
  co_await daemon_.dry_runs().remove(id);
  co_return reply({{"removed", id}});
}

}  // namespace unicursal::host
