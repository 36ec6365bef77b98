// The OpenAPI document against the daemon's real answers, and against API.md.
#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

#include "host/daemon/openapi.hpp"
#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/json_schema.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;

namespace {

std::string api_description() {
  std::ifstream file(test::source_folder() / "host/daemon/API.md");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// All "$ref" in a document.
void references(const json& place, std::set<std::string>& found) {
  if (place.is_object() && place.contains("$ref") && place["$ref"].is_string()) found.insert(place["$ref"]);
  if (place.is_structured()) {
    for (const json& inner : place) references(inner, found);
  }
}

/// The path with values that fit the bench, for what stands in braces.
std::string filled(std::string path) {
  for (std::size_t at = path.find('{'); at != std::string::npos; at = path.find('{'))
    path.replace(at, path.find('}', at) - at + 1, "1");
  return path;
}

/// Asks for everything that can be looked at, and holds it against the document.
void check_answers(const DaemonBench& bench, const json& document) {
  const test::SchemaCheck check(document);
  for (const auto& [path, operations] : document["paths"].items()) {
    if (!operations.contains("get") || operations["get"]["responses"].contains("101")) continue;
    INFO("GET " << path);
    const std::string answer = bench.send(bench.request("GET", filled(path)));
    const std::string status = std::to_string(test::status_of(answer));
    INFO(answer.substr(0, 600));
    REQUIRE(operations["get"]["responses"].contains(status));
    const json content = operations["get"]["responses"][status].value("content", json::object());
    for (const auto& [type, described] : content.items()) {
      // "application/octet-stream" in the document: any.
      if (type != "application/octet-stream")
        CHECK(answer.find("Content-Type: " + type) != std::string::npos);
      if (type != "application/json") continue;
      const json body = json::parse(answer.substr(answer.find("\r\n\r\n") + 4), nullptr, false);
      const auto faults = check.faults(body, described["schema"]);
      CHECK(faults == std::vector<std::string>{});
    }
  }
}

}  // namespace

TEST_CASE("the OpenAPI document describes every address, and API.md names it") {
  const json document = host::openapi_document();
  CHECK(document["openapi"] == "3.1.0");
  const std::string description = api_description();
  std::set<std::string> ids;
  for (const auto& [path, operations] : document["paths"].items()) {
    INFO(path);
    std::string named = path.substr(0, path.find('{'));
    if (named.size() > 1 && named.back() == '/') named.pop_back();
    CHECK(description.find(named) != std::string::npos);
    for (const auto& [method, operation] : operations.items()) {
      INFO(method);
      CHECK_FALSE(operation["summary"].get<std::string>().empty());
      CHECK(ids.insert(operation["operationId"]).second);
      for (const auto& [status, answer] : operation["responses"].items()) {
        INFO(status);
        CHECK(answer["description"] != "Unknown");
        // JSON without a schema would be left to guesses.
        if (status == "200" || status == "201") CHECK(answer.contains("content"));
      }
    }
  }
  std::set<std::string> used;
  references(document, used);
  const auto& schemas = document["components"]["schemas"];
  for (const std::string& reference : used) {
    INFO(reference);
    CHECK(document.contains(json::json_pointer(reference.substr(1))));
  }
  for (const auto& [name, schema] : schemas.items()) {
    INFO(name);
    CHECK(used.contains("#/components/schemas/" + name));
  }
}

TEST_CASE("the daemon writes its OpenAPI document, and serves the same") {
  const test::Outcome written = test::run({"serve", "--openapi"});
  CHECK(written.code == 0);
  CHECK(json::parse(written.out) == host::openapi_document());
  DaemonBench bench;
  bench.serve();
  CHECK(bench.ask("GET", "/api/openapi.json") == host::openapi_document());
}

TEST_CASE("real answers are as the OpenAPI document says, idle, printing and after a print") {
  const json document = host::openapi_document();
  DaemonBench bench;
  bench.start_printer("200");
  bench.serve({"--profile", bench.path("jobs/bench.toml.profile")});
  check_answers(bench, document);
  REQUIRE(bench.ask("POST", "/api/jobs", R"({"job": "plate.toml"})")["id"] == 1);
  bench.ask("POST", "/api/keys", R"({"name": "phone", "right": "watch"})");
  check_answers(bench, document);
  bench.ask("POST", "/api/print/start");
  bench.await_laying();
  check_answers(bench, document);
  bench.ask("POST", "/api/print/stop");
  test::await([&] { return bench.ask("GET", "/api/status")["state"] == "idle"; }, bench.daemon());
  check_answers(bench, document);
}

TEST_CASE("refusals have the code that API.md describes") {
  DaemonBench bench;
  bench.serve();
  const std::string description = api_description();
  const auto code = [&](const std::string& bytes) {
    const std::string answer = bench.send(bytes);
    const json body = json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
    CHECK(body["version"] == 1);
    CHECK_FALSE(body["error"].get<std::string>().empty());
    const std::string word = body["code"];
    CHECK(description.find("`" + word + "`") != std::string::npos);
    return word;
  };
  const auto post = [&](const std::string& target, const std::string& body) {
    return code(bench.request("POST", target, body));
  };
  CHECK(post("/api/flow", "{") == "not_json");
  CHECK(post("/api/flow", R"({"per": 1})") == "unknown_key");
  CHECK(post("/api/flow", R"({"percent": "x"})") == "bad_request");
  CHECK(post("/api/flow", R"({"percent": 95})") == "nothing_printed");
  CHECK(post("/api/jobs", R"({"job": "none.toml"})") == "not_found");
  CHECK(post("/api/status", "{}") == "wrong_method");
  CHECK(post("/api/none", "{}") == "not_found");
  CHECK(post("/api/jobs", R"({"job": "../secret.toml"})") == "bad_name");
  bench.ask("POST", "/api/jobs", R"({"job": "plate.toml"})");
  CHECK(post("/api/print/start", "{}") == "printer_absent");
  CHECK(post("/api/printer/home", "{}") == "not_connected");
  const std::string request = bench.request("GET", "/api/status");
  CHECK(code(test::replaced(request, "Bearer " + bench.token(), "Bearer x")) == "wrong_token");
  CHECK(code(test::replaced(request, "Authorization: Bearer " + bench.token(), "X: y")) == "no_token");
  CHECK(code(test::replaced(request, bench.host(), "evil.example")) == "wrong_host");
  CHECK(code(bench.request("GET", "/api/status", "", "Origin: http://evil.example\r\n")) == "other_site");
  CHECK(code(test::replaced(bench.request("POST", "/api/flow", "{}"), "application/json", "text/plain")) ==
        "wrong_type");
  CHECK(code(test::replaced(request, "Content-Length: 0", "Content-Length: 99999999")) == "too_large");
  CHECK(code(bench.request("GET", "/api/events")) == "no_upgrade");
}
