// What a page asks about a print that goes on: its line, its heat, what was said.
#include <string>

#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"
#include "host/daemon/live_json.hpp"
#include "host/daemon/query.hpp"

namespace unicursal::host {
namespace {

constexpr std::string_view layers_path = "/api/print/layers/", path_word = "/path", plan_word = "/plan";

/// N of "/api/print/layers/N/path", which the path is. Throws HttpError 404.
std::uint64_t layer_in(const std::string& path, std::string_view word) {
  return number_behind(path.substr(0, path.size() - word.size()), layers_path);
}

Response bytes_of(const PathPiece& piece) {
  Response response;
  response.type = "application/octet-stream";
  response.body = to_bytes(piece);
  return response;
}

}  // namespace

asio::awaitable<Response> Api::layers(Request) {
  co_return reply(to_json(daemon_.live().overview()));
}

asio::awaitable<Response> Api::layer_path(Request request) {
  const std::uint64_t layer = layer_in(request.path, path_word);
  const std::uint64_t from = query_whole_number(request, "from").value_or(0);
  const auto piece = co_await daemon_.path_of(layer, from);
  if (!piece) throw HttpError(404, "that layer is not known yet, or not any more");
  if (from > piece->beads)
    throw HttpError(422, "out_of_range",
                    "from is behind the layer's last bead; ask from 0 on, since its end has changed");
  co_return bytes_of(*piece);
}

asio::awaitable<Response> Api::layer_plan(Request request) {
  const std::uint64_t layer = layer_in(request.path, plan_word);
  const auto plan = daemon_.live().plan(layer);
  co_return bytes_of(plan.value_or(PathPiece{{layer, 0, 0, false, true}, 0, {}, 0, {}}));
}

asio::awaitable<Response> Api::position(Request) {
  co_return reply(daemon_.position());
}

asio::awaitable<Response> Api::temperatures(Request request) {
  co_return reply(daemon_.temperature_record().since(query_number(request, "since").value_or(0)));
}

asio::awaitable<Response> Api::log(Request request) {
  co_return reply(daemon_.log_record().since(query_whole_number(request, "since").value_or(0)));
}

}  // namespace unicursal::host
