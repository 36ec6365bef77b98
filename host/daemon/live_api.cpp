// What a page asks about a print that goes on: its line, its heat, what was said.
#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"
#include "host/daemon/query.hpp"

namespace unicursal::host {

asio::awaitable<Response> Api::temperatures(Request request) {
  co_return reply(daemon_.temperature_record().since(query_number(request, "since").value_or(0)));
}

asio::awaitable<Response> Api::log(Request request) {
  co_return reply(daemon_.log_record().since(query_whole_number(request, "since").value_or(0)));
}

}  // namespace unicursal::host
