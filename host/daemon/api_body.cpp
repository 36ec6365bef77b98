#include "host/daemon/api_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/text/wording.hpp"

namespace unicursal::host {

using nlohmann::json;

namespace {

struct Answered {
  int status;
  const char* code;  ///< API.md
};

Answered answered_as(Refused::Why why) {
  switch (why) {
    case Refused::Why::bad_name:
      return {400, "bad_name"};
    case Refused::Why::not_found:
      return {404, "not_found"};
    case Refused::Why::conflict:
      return {409, "conflict"};
    case Refused::Why::printing:
      return {409, "busy"};
    case Refused::Why::absent:
      return {409, "printer_absent"};
    case Refused::Why::bad_value:
      return {422, "out_of_range"};
    case Refused::Why::bad_job:
      return {422, "bad_job"};
    case Refused::Why::bad_kind:
      return {415, "bad_kind"};
    case Refused::Why::busy:
      return {503, "too_many"};
    case Refused::Why::no_room:
      break;
  }
  return {507, "no_room"};
}

}  // namespace

bool is_deeper_than(std::string_view text, std::size_t levels) {
  std::size_t depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') {
      ++i;  // what follows is a part of the text
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      if (++depth > levels) return true;
    } else if (!in_text && (c == ']' || c == '}')) {
      depth -= depth > 0 ? 1 : 0;
    }
  }
  return false;
}

HttpError http_error(const Refused& refused) {
  const auto [status, code] = answered_as(refused.why());
  return {status, refused.code() ? refused.code() : code, refused.what()};
}

std::array<bool, 3> axes_of(const json& body) {
  const auto found = body.find("axes");
  if (found == body.end()) return {true, true, true};
  std::array<bool, 3> axes{};
  if (!found->is_array() || found->empty()) throw HttpError(400, "axes is a list such as [\"x\", \"y\"]");
  for (const json& axis : *found) {
    const std::string name = axis.is_string() ? axis.get<std::string>() : "";
    const auto at = std::string_view("xyz").find(name);
    if (name.size() != 1 || at == std::string_view::npos)
      throw HttpError(400, "axes is a list of \"x\", \"y\" and \"z\"");
    axes[at] = true;
  }
  return axes;
}

HttpError http_error(const IdleRefused& refused) {
  if (refused.why() == IdleRefused::Why::limit) return {422, "out_of_range", refused.what()};
  return {409, refused.code() ? refused.code() : "conflict", refused.what()};
}

Response plain_reply(const json& body, int status) {
  Response response;
  response.status = status;
  response.body = body.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  return response;
}

Response reply(json body, int status) {
  body["version"] = 1;
  return plain_reply(body, status);
}

json read_object(const Request& request) {
  if (request.body.empty()) return json::object();
  std::string type = core::lower(request.header("content-type").value_or(""));
  type.resize(std::min(type.find(';'), type.size()));  // parameters follow (RFC 9110, 8.3.1)
  type.resize(type.find_last_not_of(" \t") + 1);
  if (type != "application/json") throw HttpError(415, "send JSON, as Content-Type: application/json");
  if (is_deeper_than(request.body, deepest_body))
    throw HttpError(
        400, "too_deep",
        fmt::format("the body is nested more than {} levels deep; send a flatter one", deepest_body));
  json body = json::parse(request.body, nullptr, false);
  if (!body.is_object()) throw HttpError(400, "not_json", "the body is not a JSON object");
  return body;
}

json read_object(const Request& request, std::initializer_list<const char*> keys) {
  json body = read_object(request);
  for (const auto& [key, value] : body.items()) {
    const bool known = std::any_of(keys.begin(), keys.end(), [&](const char* one) { return key == one; });
    if (!known) throw HttpError(400, "unknown_key", "a key is not known here: \"" + key.substr(0, 40) + "\"");
  }
  return body;
}

std::string text_in(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || found->is_null()) return {};
  if (!found->is_string()) throw HttpError(400, fmt::format("{} is not a text", key));
  return found->get<std::string>();
}

bool yes(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) return false;
  if (!found->is_boolean()) throw HttpError(400, fmt::format("{} is not true or false", key));
  return found->get<bool>();
}

void obeyed(const std::optional<std::string>& refusal) {
  if (refusal) throw HttpError(409, *refusal);
}

std::uint64_t number_behind(const std::string& path, std::string_view prefix) {
  std::uint64_t id = 0;
  const char* end = path.data() + path.size();
  const auto [stop, error] = std::from_chars(path.data() + prefix.size(), end, id);
  if (error != std::errc() || stop != end) throw HttpError(404, "it is named by its number");
  return id;
}

std::optional<LayerRange> layers_in(const nlohmann::json& body) {
  const auto found = body.find("layers");
  if (found == body.end()) return std::nullopt;
  if (!found->is_array() || found->size() != 2 || !found->at(0).is_number_unsigned() ||
      !found->at(1).is_number_unsigned())
    throw HttpError(400, "layers is [first, last], counted from 0");
  if (found->at(0).get<std::size_t>() > found->at(1).get<std::size_t>())
    throw HttpError(422, "layers is [first, last]; the first is behind the last");
  return LayerRange{found->at(0).get<std::size_t>(), found->at(1).get<std::size_t>()};
}

std::pair<std::string, std::string> names_behind(const std::string& path, std::string_view prefix) {
  const std::string names = path.substr(prefix.size());
  const std::size_t slash = names.find('/');
  if (slash == std::string::npos) return {names, ""};
  return {names.substr(0, slash), names.substr(slash + 1)};
}

}  // namespace unicursal::host
