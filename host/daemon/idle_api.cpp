// The requests that concern a printer while nothing is printed.
#include <fmt/format.h>

#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

std::optional<double> measure_in(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || found->is_null()) return std::nullopt;
  if (!found->is_number()) throw HttpError(400, fmt::format("{} is not a number", key));
  return found->get<double>();
}

FeedingOrder order_in(const json& body) {
  const std::string action = text_in(body, "action");
  FeedingOrder order;
  if (action == "load")
    order.kind = FeedingKind::load;
  else if (action == "purge")
    order.kind = FeedingKind::purge;
  else if (action == "unload")
    order.kind = FeedingKind::unload;
  else
    throw HttpError(400, "action is \"load\", \"purge\" or \"unload\"");
  if (const auto feeder = body.find("feeder"); feeder != body.end() && !feeder->is_null()) {
    if (!feeder->is_number_unsigned()) throw HttpError(400, "feeder is a whole number, counted from 1");
    if (*feeder == 0) throw HttpError(422, "out_of_range", "feeders are counted from 1");
    order.feeder = feeder->get<std::size_t>() - 1;
  }
  order.length = measure_in(body, "length");
  return order;
}

}  // namespace

asio::awaitable<Response> Api::connect_printer(Request request) {
  daemon_.connect_printer(text_in(read_object(request, {"port"}), "port"));
  co_return reply(whole_printer(), 202);
}

asio::awaitable<Response> Api::disconnect_printer(Request request) {
  read_object(request, {});
  daemon_.disconnect_printer();
  co_return reply(whole_printer(), 202);
}

asio::awaitable<Response> Api::heat(Request request) {
  const json body = read_object(request, {"nozzle_c", "bed_c"});
  const auto nozzle = measure_in(body, "nozzle_c"), bed = measure_in(body, "bed_c");
  if (!nozzle && !bed) throw HttpError(400, "nozzle_c or bed_c is missing");
  daemon_.idle().heat(nozzle, bed);
  co_return reply(whole_printer(), 202);
}

asio::awaitable<Response> Api::home(Request request) {
  const auto axes = axes_of(read_object(request, {"axes"}));
  daemon_.idle().home(axes);
  co_return reply(whole_printer(), 202);
}

asio::awaitable<Response> Api::move_head(Request request) {
  const json body = read_object(request, {"x", "y", "z"});
  const std::array<double, 3> by{measure_in(body, "x").value_or(0), measure_in(body, "y").value_or(0),
                                 measure_in(body, "z").value_or(0)};
  if (by == std::array<double, 3>{}) throw HttpError(400, "x, y or z is missing: how many mm to move");
  daemon_.idle().move(by);
  co_return reply(whole_printer(), 202);
}

asio::awaitable<Response> Api::set_fan(Request request) {
  const auto percent = measure_in(read_object(request, {"percent"}), "percent");
  if (!percent) throw HttpError(400, "percent is missing");
  daemon_.idle().fan(*percent);
  co_return reply(whole_printer(), 202);
}

asio::awaitable<Response> Api::feed(Request request) {
  const FeedingOrder order = order_in(read_object(request, {"action", "feeder", "length"}));
  try {
    daemon_.idle().feed(order);
  } catch (const core::DataError& error) {
    throw HttpError(422, "out_of_range", error.problem() + "; " + error.remedy());
  }
  co_return reply(whole_printer(), 202);
}

asio::awaitable<Response> Api::cancel_idle(Request request) {
  read_object(request, {});
  daemon_.idle().cancel();
  co_return reply(whole_printer(), 202);
}

}  // namespace unicursal::host
