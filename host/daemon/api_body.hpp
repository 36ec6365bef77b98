// What the handlers of requests share: reading JSON, and answering with it.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "host/daemon/refused.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/http/http_message.hpp"
#include "host/idle/idle_printer.hpp"

namespace unicursal::host {

/// With `"version": 1`.
Response reply(nlohmann::json body, int status = 200);
/// As it is.
Response plain_reply(const nlohmann::json& body, int status = 200);

/// Levels of a client's JSON: more of them cost stack when a value is copied.
inline constexpr std::size_t deepest_body = 64;
/// Whether lists and objects lie in one another so deep. The text need not be JSON.
bool is_deeper_than(std::string_view text, std::size_t levels);

/// Reads an object; an empty body is an empty object. Throws HttpError 400 or 415.
nlohmann::json read_object(const Request& request);
/// The same; the object has known keys only.
nlohmann::json read_object(const Request& request, std::initializer_list<const char*> keys);

/// Throws HttpError 400 if it is there and not a text; absent: empty.
std::string text_in(const nlohmann::json& body, const char* key);
/// Throws HttpError 400 if it is there and not true or false; absent: false.
bool yes(const nlohmann::json& body, const char* key);

/// `layers`, if it is there. Throws HttpError 400 or 422.
std::optional<LayerRange> layers_in(const nlohmann::json& body);

/// "axes", such as ["x", "y"]; absent: all. Throws HttpError 400.
std::array<bool, 3> axes_of(const nlohmann::json& body);

/// Throws HttpError 409 if a session has refused.
void obeyed(const std::optional<std::string>& refusal);

/// With the status that fits.
HttpError http_error(const Refused& refused);
HttpError http_error(const IdleRefused& refused);

/// The number behind `prefix` in a path. Throws HttpError 404.
std::uint64_t number_behind(const std::string& path, std::string_view prefix);

/// "upload/file" behind `prefix` in a path; the second is empty without a slash.
std::pair<std::string, std::string> names_behind(const std::string& path, std::string_view prefix);

}  // namespace unicursal::host
