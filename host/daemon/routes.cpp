// All addresses of the API. A new one needs a row here with its text, a schema (schemas.json) if it answers
// with JSON of its own, and a row in API.md.
#include <algorithm>

#include "host/daemon/route.hpp"

namespace unicursal::host {
namespace {

/// Removes the first segment from `path`, without its slash, and returns it.
std::string_view next_segment(std::string_view& path) {
  path.remove_prefix(1);
  const std::string_view segment = path.substr(0, path.find('/'));
  path.remove_prefix(segment.size());
  return segment;
}

}  // namespace

bool Api::Route::matches(std::string_view asked) const {
  if (path == "/") return asked == path;
  if (path.back() == '/') return asked.size() > path.size() && asked.starts_with(path);
  std::string_view pattern = path;
  while (!pattern.empty() && !asked.empty()) {
    const std::string_view wanted = next_segment(pattern), given = next_segment(asked);
    if (wanted.starts_with('{') ? given.empty() : wanted != given) return false;
  }
  return pattern.empty() && asked.empty();
}

std::span<const Api::Route> Api::Route::all() {
  using enum Right;
  constexpr auto for_strangers = true;
  static constexpr Route routes[] = {
      // clang-format off
      {"GET", "/", &Api::show_page, watch,
       {.says = "the page for a browser", .type = "text/html"}, for_strangers},
      {"GET", Page::assets_path, &Api::show_page, watch,
       {.says = "its parts", .refuses = {404}, .behind = "{name}",
        .type = "application/octet-stream"}, for_strangers},
      {"GET", "/api/status", &Api::status, watch, {.says = "what the daemon is doing", .gives = "Status"}},
      {"GET", "/api/printer", &Api::printer, watch,
       {.says = "the printer", .gives = "Printer", .refuses = {409}}},
      {"GET", "/api/events", nullptr, watch,
       {.says = "a WebSocket of events", .status = 101, .refuses = {426}}},
      {"GET", "/metrics", &Api::metrics, watch, {.says = "numbers for Prometheus", .type = "text/plain"}},
      {"GET", "/api/jobs", &Api::list_jobs, watch, {.says = "the queue", .gives = "Jobs"}},
      {"POST", "/api/jobs", &Api::add_job, queue,
       {.says = "queues a job", .takes = "NewJob", .gives = "Id", .status = 201,
        .refuses = {404, 409, 422, 507}}},
      {"PUT", "/api/jobs/order", &Api::arrange_jobs, queue,
       {.says = "the order of the waiting jobs", .takes = "Order", .gives = "Order",
        .refuses = {409, 507}}},
      {"POST", "/api/jobs/{id}/copy", &Api::copy_job, queue,
       {.says = "queues the same job once more", .takes = "Nothing", .gives = "Id", .status = 201,
        .refuses = {404, 409, 422, 507}}},
      {"GET", "/api/jobs/", &Api::show_job, watch, {.says = "one job", .gives = "Job", .refuses = {404}}},
      {"DELETE", "/api/jobs/", &Api::remove_job, queue,
       {.says = "removes a job", .gives = "Removed", .refuses = {404, 409}}},
      {"GET", "/api/files", &Api::list_files, watch, {.says = "what can be queued", .gives = "Files"}},
      {"GET", "/api/files/local", &Api::octo_files, watch, {.says = "OctoPrint: files", .gives = "Octo"}},
      {"GET", "/api/files/local/", &Api::octo_file, watch,
       {.says = "OctoPrint: one file", .gives = "Octo", .refuses = {404}, .behind = "{name}"}},
      {"POST", "/api/files/local", &Api::octo_upload, queue,
       {.says = "OctoPrint: sends a file as a form", .takes = "Form", .gives = "Octo", .status = 201,
        .refuses = {413, 415, 422, 507}}},
      {"POST", "/api/files/local/", &Api::octo_select, queue,
       {.says = "OctoPrint: queues a file", .takes = "Command", .status = 204, .refuses = {404, 409, 422},
        .behind = "{name}"}},
      {"DELETE", "/api/files/local/", &Api::octo_delete, queue,
       {.says = "OctoPrint: removes an upload", .status = 204, .refuses = {404, 409}, .behind = "{name}"}},
      {"PUT", "/api/files/", &Api::keep_file, queue,
       {.says = "uploads a file of a job", .takes = "Bytes", .gives = "Uploaded", .status = 201,
        .refuses = {409, 413, 507}, .behind = "{folder}/{file}"}},
      {"DELETE", "/api/files/", &Api::remove_upload, queue,
       {.says = "removes an upload", .gives = "Removed", .refuses = {404, 409}, .behind = "{folder}"}},
      {"POST", "/api/print/start", &Api::start, steer,
       {.says = "prints a job that waits", .takes = "Start", .gives = "Id", .status = 202,
        .refuses = {404, 409}}},
      {"POST", "/api/print/pause", &Api::pause, steer,
       {.says = "pauses", .takes = "Nothing", .gives = "Status", .status = 202, .refuses = {409}}},
      {"POST", "/api/print/resume", &Api::resume, steer,
       {.says = "goes on, also with an interrupted print", .takes = "Sure", .gives = "Status",
        .status = 202, .refuses = {409}}},
      {"POST", "/api/print/answer", &Api::answer_prompt, steer,
       {.says = "answers the printer's question", .takes = "Button", .gives = "Status", .status = 202,
        .refuses = {409}}},
      {"POST", "/api/print/cancel", &Api::cancel, steer,
       {.says = "parks and cools", .takes = "Nothing", .gives = "Status", .status = 202, .refuses = {409}}},
      {"POST", "/api/print/stop", &Api::stop, steer,
       {.says = "stops at once (M112)", .takes = "Nothing", .gives = "Status", .status = 202,
        .refuses = {409}}},
      {"POST", "/api/bed", &Api::confirm_bed, steer,
       {.says = "confirms that the bed is clear", .takes = "Clear", .gives = "Status", .status = 202,
        .refuses = {409}}},
      {"POST", "/api/temperature", &Api::set_temperature, steer,
       {.says = "sets the heat of the print", .takes = "Heat", .gives = "Status", .status = 202,
        .refuses = {409}}},
      {"POST", "/api/flow", &Api::set_flow, steer,
       {.says = "sets the flow", .takes = "Percent", .gives = "Status", .status = 202, .refuses = {409}}},
      {"POST", "/api/speed", &Api::set_speed, steer,
       {.says = "sets the speed", .takes = "Percent", .gives = "Status", .status = 202, .refuses = {409}}},
      {"POST", "/api/token/renew", &Api::renew_token, Right::all,
       {.says = "makes new tokens; through the socket only", .takes = "Nothing", .gives = "Done",
        .refuses = {409}}},
      {"GET", "/api/keys", &Api::list_keys, Right::all, {.says = "keys of single programs", .gives = "Keys"}},
      {"POST", "/api/keys", &Api::add_key, Right::all,
       {.says = "makes a key", .takes = "NewKey", .gives = "NewKeyMade", .status = 201,
        .refuses = {409, 507}}},
      {"POST", "/api/keys/", &Api::decide_key, Right::all,
       {.says = "grants or denies a request for a key", .takes = "Decision", .gives = "Decided",
        .refuses = {404, 409, 507}}},
      {"DELETE", "/api/keys/", &Api::remove_key, Right::all,
       {.says = "removes a key", .gives = "Removed", .refuses = {404, 507}}},
      {"GET", "/api/history", &Api::list_history, watch,
       {.says = "prints that have ended, the newest first, and the sums of all", .gives = "History",
        .refuses = {503, 507}, .query = "before,limit"}},
      {"GET", "/api/history.csv", &Api::history_table, watch,
       {.says = "the same as a table for spreadsheets", .refuses = {503, 507}, .type = "text/csv"}},
      {"GET", "/api/history/{id}", &Api::show_past_print, watch,
       {.says = "one print that has ended", .gives = "PastPrint", .refuses = {404, 503, 507}}},
      {"GET", "/api/history/{id}/picture", &Api::past_picture, watch,
       {.says = "its first layer", .refuses = {404, 503, 507}, .type = "image/png"}},
      {"PUT", "/api/history/{id}", &Api::note_past_print, queue,
       {.says = "gives it a note", .takes = "Note", .gives = "Id", .refuses = {404, 422, 503, 507}}},
      {"DELETE", "/api/history/{id}", &Api::remove_past_print, steer,
       {.says = "removes it from the history", .gives = "Removed", .refuses = {404, 503, 507}}},
      {"POST", "/api/history/{id}/again", &Api::print_again, queue,
       {.says = "queues its job", .takes = "Nothing", .gives = "Id", .status = 201,
        .refuses = {404, 409, 422, 503, 507}}},
      {"GET", "/api/prints", &Api::list_prints, watch,
       {.says = "prints that are kept, and whether they may be continued", .gives = "Prints"}},
      {"GET", "/api/print/layers", &Api::layers, watch,
       {.says = "the layers of the print that goes on", .gives = "Layers", .refuses = {409}}},
      {"GET", "/api/print/layers/{id}/path", &Api::layer_path, watch,
       {.says = "the line of one layer", .refuses = {404, 409, 422}, .query = "from",
        .type = "application/octet-stream"}},
      {"GET", "/api/print/position", &Api::position, watch,
       {.says = "where the nozzle is", .gives = "Position", .refuses = {409}}},
      {"GET", "/api/temperatures", &Api::temperatures, watch,
       {.says = "the last hour's heat", .gives = "Temperatures", .query = "since"}},
      {"GET", "/api/log", &Api::log, watch,
       {.says = "the last lines to and from the printer", .gives = "Log", .query = "since"}},
      {"GET", "/api/dry-runs", &Api::list_dry_runs, watch,
       {.says = "the dry runs that are kept", .gives = "DryRuns"}},
      {"POST", "/api/dry-runs", &Api::start_dry_run, queue,
       {.says = "tries a job on a simulated printer", .takes = "NewJob", .gives = "Id", .status = 201,
        .refuses = {404, 409, 422, 507}}},
      {"GET", "/api/dry-runs/{id}", &Api::show_dry_run, watch,
       {.says = "one dry run", .gives = "DryRun", .refuses = {404}}},
      {"GET", "/api/dry-runs/", &Api::show_dry_run, watch,
       {.says = "its page, pictures and report", .refuses = {404}, .behind = "{id}/{file}",
        .type = "application/octet-stream"}},
      {"DELETE", "/api/dry-runs/", &Api::remove_dry_run, queue,
       {.says = "removes a dry run, and ends it", .gives = "Removed", .refuses = {404}}},
      {"GET", "/api/preferences", &Api::show_preferences, watch,
       {.says = "what the page's users have chosen", .gives = "Preferences"}},
      {"PUT", "/api/preferences", &Api::set_preferences, steer,
       {.says = "changes it; the camera's address with the token only", .takes = "NewPreferences",
        .gives = "Preferences", .refuses = {422, 507}}},
      {"GET", "/api/camera", &Api::camera, watch,
       {.says = "a picture of the camera, JPEG or PNG", .refuses = {404, 502, 504}, .type = "image/jpeg"}},
      {"GET", "/api/openapi.json", &Api::openapi, watch, {.says = "this document", .gives = "OpenApi"}},
      {"GET", "/api/version", &Api::octo_version, watch, {.says = "OctoPrint: versions", .gives = "Octo"}},
      {"GET", "/api/server", &Api::octo_server, watch, {.says = "OctoPrint: the server", .gives = "Octo"}},
      {"POST", "/api/login", &Api::login, watch,
       {.says = "opens a browser's session; for OctoPrint's clients: who has this key", .takes = "Login",
        .gives = "LoggedIn"}, for_strangers},
      {"POST", "/api/logout", &Api::logout, watch,
       {.says = "ends the session", .takes = "Nothing", .gives = "Done"}},
      {"GET", "/api/currentuser", &Api::octo_user, watch,
       {.says = "OctoPrint: who has this key", .gives = "Octo"}},
      {"GET", "/api/settings", &Api::octo_settings, watch, {.says = "OctoPrint: settings", .gives = "Octo"}},
      {"GET", "/api/printerprofiles", &Api::octo_profiles, watch,
       {.says = "OctoPrint: profiles", .gives = "Octo"}},
      {"GET", "/api/connection", &Api::octo_connection, watch,
       {.says = "OctoPrint: the connection", .gives = "Octo"}},
      {"POST", "/api/connection", &Api::octo_connect, steer,
       {.says = "OctoPrint: opens or closes the port", .takes = "Command", .status = 204, .refuses = {409}}},
      {"GET", "/api/printer/tool", &Api::octo_tool, watch,
       {.says = "OctoPrint: the nozzle", .gives = "Octo"}},
      {"POST", "/api/printer/tool", &Api::octo_set_tool, steer,
       {.says = "OctoPrint: heats the nozzle", .takes = "Command", .status = 204, .refuses = {409}}},
      {"GET", "/api/printer/bed", &Api::octo_bed, watch, {.says = "OctoPrint: the bed", .gives = "Octo"}},
      {"POST", "/api/printer/bed", &Api::octo_set_bed, steer,
       {.says = "OctoPrint: heats the bed", .takes = "Command", .status = 204, .refuses = {409}}},
      {"POST", "/api/printer/printhead", &Api::octo_move, steer,
       {.says = "OctoPrint: moves the head", .takes = "Command", .status = 204, .refuses = {409}}},
      {"POST", "/api/printer/command", &Api::octo_send, steer,
       {.says = "OctoPrint: M112", .takes = "Command", .status = 204, .refuses = {409}}},
      {"GET", "/api/job", &Api::octo_job, watch, {.says = "OctoPrint: the print", .gives = "Octo"}},
      {"POST", "/api/job", &Api::octo_steer, steer,
       {.says = "OctoPrint: steers the print", .takes = "Command", .status = 204, .refuses = {409}}},
      {"GET", push_path, nullptr, watch,
       {.says = "OctoPrint: a WebSocket of events", .status = 101, .refuses = {426}}, for_strangers},
      {"GET", "/plugin/appkeys/probe", &Api::octo_probe_keys, watch,
       {.says = "OctoPrint: whether keys can be asked for", .status = 204}, for_strangers},
      {"POST", "/plugin/appkeys/request", &Api::octo_request_key, watch,
       {.says = "OctoPrint: asks for a key", .takes = "App", .gives = "Octo", .status = 201}, for_strangers},
      {"GET", "/plugin/appkeys/request/", &Api::octo_poll_key, watch,
       {.says = "OctoPrint: what has become of it", .gives = "Octo", .refuses = {404},
        .behind = "{ticket}"}, for_strangers},
      // clang-format on
  };
  return routes;
}

}  // namespace unicursal::host
