// Requests about prints that have ended (API.md).
#include <charconv>

#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"
#include "host/daemon/refused.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::string_view history_path = "/api/history/", jobs_prefix = "/api/jobs/",
                           prints_prefix = "/api/prints/";
constexpr std::size_t usual_count = 50;  ///< prints in an answer

/// The number of a parameter behind the question mark. Throws HttpError 400.
std::optional<std::int64_t> number_of_query(const std::string& query, std::string_view name) {
  std::string_view rest = query;
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    if (!one.starts_with(name) || one.substr(name.size()).substr(0, 1) != "=") continue;
    const std::string_view text = one.substr(name.size() + 1);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0)
      throw HttpError(400, std::string(name) + " is not a whole number");
    return number;
  }
  return std::nullopt;
}

/// "7" of /api/history/7/picture. Throws HttpError 404.
std::int64_t id_behind(const std::string& path, std::string_view prefix) {
  return static_cast<std::int64_t>(number_behind(path.substr(0, path.find('/', prefix.size())), prefix));
}

Response with_type(std::string type, std::string body) {
  Response response;
  response.type = std::move(type);
  response.body = std::move(body);
  return response;
}

}  // namespace

asio::awaitable<Response> Api::list_history(Request request) {
  const auto before = number_of_query(request.query, "before");
  const auto limit = number_of_query(request.query, "limit");
  const std::size_t most = limit ? static_cast<std::size_t>(*limit) : usual_count;
  co_return reply(co_await daemon_.past_prints().list(before, most, daemon_.printing_as()));
}

asio::awaitable<Response> Api::history_table(Request) {
  Response table = with_type("text/csv; charset=utf-8", co_await daemon_.past_prints().csv());
  table.headers.emplace_back("Content-Disposition", "attachment; filename=\"history.csv\"");
  co_return table;
}

asio::awaitable<Response> Api::show_past_print(Request request) {
  const std::int64_t id = id_behind(request.path, history_path);
  co_return reply(to_json(co_await daemon_.past_prints().find(id)));
}

asio::awaitable<Response> Api::past_picture(Request request) {
  const std::int64_t id = id_behind(request.path, history_path);
  co_return with_type("image/png", co_await daemon_.past_prints().picture(id));
}

asio::awaitable<Response> Api::note_past_print(Request request) {
  const std::int64_t id = id_behind(request.path, history_path);
  const json body = read_object(request, {"note"});
  if (!body.contains("note")) throw HttpError(400, "note is missing");
  std::string note = text_in(body, "note");
  if (note.size() > History::longest_note) throw HttpError(422, "the note is too long");
  co_await daemon_.past_prints().set_note(id, std::move(note));
  co_return reply({{"id", id}});
}

asio::awaitable<Response> Api::remove_past_print(Request request) {
  const std::int64_t id = id_behind(request.path, history_path);
  co_await daemon_.past_prints().remove(id);
  co_return reply({{"removed", id}});
}

asio::awaitable<Response> Api::print_again(Request request) {
  const std::int64_t id = id_behind(request.path, history_path);
  read_object(request, {});
  PastPrint print = co_await daemon_.past_prints().find(id);
  const std::uint64_t queued = co_await daemon_.print_again(std::move(print));
  co_return reply({{"id", queued}}, 201);
}

asio::awaitable<Response> Api::job_picture(Request request) {
  const auto id = static_cast<std::uint64_t>(id_behind(request.path, jobs_prefix));
  Response picture = with_type("image/png", co_await daemon_.job_picture(id));
  picture.headers.emplace_back("Cache-Control", "private, max-age=3600");  // numbers are never given twice
  co_return picture;
}

/// A print whose name cannot stand in an address is named in the body.
asio::awaitable<Response> Api::resume_print(Request request) {
  const json body = read_object(request, {"name", "sure"});
  std::string name = text_in(body, "name");
  if (request.path != std::string(prints_prefix) + "resume")
    name = request.path.substr(prints_prefix.size(), request.path.rfind('/') - prints_prefix.size());
  if (name.empty()) throw HttpError(400, "name is missing: of the print");
  if (yes(body, "sure")) {
    const std::uint64_t id = co_await daemon_.resume_kept(std::move(name));
    co_return reply({{"id", id}}, 202);
  }
  const std::string will = co_await daemon_.would_resume(std::move(name));
  co_return reply({{"will", will}});
}

asio::awaitable<Response> Api::copy_job(Request request) {
  const auto id = static_cast<std::uint64_t>(id_behind(request.path, jobs_prefix));
  read_object(request, {});
  const std::uint64_t queued = co_await daemon_.copy(id);
  co_return reply({{"id", queued}}, 201);
}

asio::awaitable<Response> Api::arrange_jobs(Request request) {
  const json body = read_object(request, {"ids"});
  const auto list = body.find("ids");
  if (list == body.end() || !list->is_array()) throw HttpError(400, "ids is missing: the numbers of jobs");
  std::vector<std::uint64_t> ids;
  for (const json& one : *list) {
    if (!one.is_number_unsigned()) throw HttpError(400, "ids are the numbers of jobs");
    ids.push_back(one.get<std::uint64_t>());
  }
  co_await daemon_.arrange(std::move(ids));
  co_return reply({{"ids", daemon_.queue().order()}});
}

asio::awaitable<Response> Api::list_prints(Request) {
  co_return reply(co_await daemon_.past_prints().kept(daemon_.printing_as()));
}

}  // namespace unicursal::host
