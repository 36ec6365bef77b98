#include "host/daemon/openapi.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/text/wording.hpp"
#include "host/daemon/route.hpp"

namespace unicursal::host {
namespace {

using Json = nlohmann::json;

Json schema_ref(std::string_view name) {
  return {{"$ref", fmt::format("#/components/schemas/{}", name)}};
}

Json parameter(const std::string& name, bool in_path) {
  return {{"name", name},
          {"in", in_path ? "path" : "query"},
          {"required", in_path},
          {"schema", {{"type", "string"}}}};
}

/// What stands in braces in the path, and in the query.
Json parameters(const std::string& path, std::string_view query) {
  Json all = Json::array();
  for (std::size_t at = path.find('{'); at != std::string::npos; at = path.find('{', at + 1))
    all.push_back(parameter(path.substr(at + 1, path.find('}', at) - at - 1), true));
  while (!query.empty()) {
    const std::size_t end = std::min(query.find(','), query.size());
    all.push_back(parameter(std::string(query.substr(0, end)), false));
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return all;
}

/// "get_api_jobs_id"
std::string operation_id(std::string_view method, const std::string& path) {
  std::string id = core::lower(method);
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain)
      id += c;
    else if (id.back() != '_')
      id += '_';
  }
  while (id.back() == '_') id.pop_back();
  return id;
}

Json answers(const RouteText& text, bool open) {
  Json all = Json::object();
  Json& good = all[std::to_string(text.status)];
  good["description"] = status_words(text.status);
  if (!text.gives.empty())
    good["content"]["application/json"]["schema"] = schema_ref(text.gives);
  else if (text.type != RouteText{}.type)
    good["content"][std::string(text.type)] = Json::object();
  std::set<int> refusals{400, 421, 503};
  if (!open) refusals.insert({401, 403});
  if (!text.takes.empty()) refusals.insert({413, 415});
  for (const int status : text.refuses) {
    if (status != 0) refusals.insert(status);
  }
  for (const int status : refusals) {
    if (status == text.status) continue;
    all[std::to_string(status)] = {{"description", status_words(status)},
                                   {"content", {{"application/json", {{"schema", schema_ref("Refusal")}}}}}};
  }
  return all;
}

Json taken(std::string_view schema) {
  if (schema == "Bytes")
    return {{"required", true}, {"content", {{"application/octet-stream", Json::object()}}}};
  if (schema == "Form") return {{"required", true}, {"content", {{"multipart/form-data", Json::object()}}}};
  return {{"required", schema != "Nothing"},
          {"content", {{"application/json", {{"schema", schema_ref(schema)}}}}}};
}

}  // namespace

nlohmann::json openapi_document() {
  Json document = Json::parse(api_schemas);
  document["openapi"] = "3.1.0";
  document["info"] = {
      {"title", "unicursal serve"},
      {"version", "1"},
      {"description", "The daemon's API, and the part of OctoPrint's that it speaks; see API.md."}};
  document["servers"][0]["url"] = "/";
  document["components"]["securitySchemes"] = {
      {"token", {{"type", "http"}, {"scheme", "bearer"}}},
      {"key", {{"type", "apiKey"}, {"in", "header"}, {"name", "X-Api-Key"}}}};
  Json proofs = Json::array();
  proofs[0]["token"] = proofs[1]["key"] = Json::array();
  for (const Api::Route& route : Api::Route::all()) {
    std::string path(route.path);
    if (path.size() > 1 && path.back() == '/') path += route.text.behind;
    Json& operation = document["paths"][path][core::lower(route.method)];
    operation["operationId"] = operation_id(route.method, path);
    operation["summary"] = route.text.says;
    operation["x-right"] = route.open ? "none" : name(route.right);
    operation["security"] = route.open ? Json::array() : proofs;
    const Json places = parameters(path, route.text.query);
    if (!places.empty()) operation["parameters"] = places;
    if (!route.text.takes.empty()) operation["requestBody"] = taken(route.text.takes);
    operation["responses"] = answers(route.text, route.open);
  }
  return document;
}

}  // namespace unicursal::host
