// What the daemon serves to a browser before anybody has shown a right: the page and its parts.
#include <catch2/catch.hpp>

#include "host/files/web_files.hpp"
#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using test::DaemonBench;

namespace {

/// As a browser asks that has no token. `more`: further headers, each with its line end.
std::string asked(const DaemonBench& bench, const std::string& target, const std::string& more = {},
                  const std::string& method = "GET") {
  return bench.send(method + " " + target + " HTTP/1.1\r\nHost: " + bench.host() + "\r\n" + more +
                    "Connection: close\r\n\r\n");
}

std::string value_of(const std::string& answer, const std::string& header) {
  const std::size_t at = answer.find("\r\n" + header + ": "), begin = at + header.size() + 4;
  return at == std::string::npos ? "" : answer.substr(begin, answer.find("\r\n", begin) - begin);
}

std::string body_of(const std::string& answer) {
  return answer.substr(answer.find("\r\n\r\n") + 4);
}

const std::string reads_gzip = "Accept-Encoding: deflate, gzip;q=0.8\r\n";

}  // namespace

TEST_CASE("a program without its page says so, and serves its API") {
  if (!host::web_files().empty()) return;
  DaemonBench bench;
  bench.serve();
  const std::string answer = asked(bench, "/");
  CHECK(test::status_of(answer) == 404);
  CHECK(answer.find("UNICURSAL_WEB=OFF") != std::string::npos);
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
}

TEST_CASE("everybody gets the page, with the rules that keep other sites' scripts out of it") {
  if (host::web_files().empty()) return;
  DaemonBench bench;
  bench.serve();
  const std::string page = asked(bench, "/");
  CHECK(test::status_of(page) == 200);
  CHECK(value_of(page, "Content-Type") == "text/html; charset=utf-8");
  CHECK(value_of(page, "Content-Security-Policy") ==
        "default-src 'self'; img-src 'self' data: blob:; connect-src 'self'; frame-ancestors 'none'; "
        "base-uri 'none'; form-action 'self'");
  CHECK(page.find("default-src 'none'") == std::string::npos);  // a browser would obey both
  CHECK(value_of(page, "X-Content-Type-Options") == "nosniff");
  CHECK(value_of(page, "Referrer-Policy") == "no-referrer");
  CHECK(value_of(page, "Cache-Control") == "no-cache");
  CHECK(body_of(page).starts_with("<!doctype html>"));
  CHECK(body_of(asked(bench, "/assets/index.html")) == body_of(page));
  // A link of another site may lead to the page, but a name that is not this computer's may not.
  CHECK(test::status_of(asked(bench, "/", "Sec-Fetch-Site: cross-site\r\n")) == 200);
  CHECK(test::status_of(bench.send("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n")) ==
        421);
  for (const auto& [name, type] : {std::pair("page.js", "text/javascript; charset=utf-8"),
                                   {"page.css", "text/css; charset=utf-8"},
                                   {"en.json", "application/json"},
                                   {"de.json", "application/json"},
                                   {"icon.svg", "image/svg+xml"}}) {
    INFO(name);
    const std::string answer = asked(bench, std::string("/assets/") + name);
    CHECK(test::status_of(answer) == 200);
    CHECK(value_of(answer, "Content-Type") == type);
    CHECK(value_of(answer, "X-Content-Type-Options") == "nosniff");
    CHECK_FALSE(body_of(answer).empty());
  }
}

TEST_CASE("a browser gets the page packed, and again only when it has changed") {
  if (host::web_files().empty()) return;
  DaemonBench bench;
  bench.serve();
  const std::string plain = asked(bench, "/assets/page.js");
  const std::string packed = asked(bench, "/assets/page.js", reads_gzip);
  CHECK(value_of(plain, "Content-Encoding").empty());
  CHECK(value_of(packed, "Content-Encoding") == "gzip");
  CHECK(value_of(packed, "Vary") == "Accept-Encoding");
  CHECK(body_of(packed).starts_with("\x1f\x8b"));
  CHECK(host::unpacked({"page.js", body_of(packed), ""}) == body_of(plain));
  CHECK(value_of(asked(bench, "/assets/page.js", "Accept-Encoding: gzip;q=0, br\r\n"), "Content-Encoding")
            .empty());
  // Two encodings are two representations (RFC 9110, 8.8.3.3).
  const std::string tag = value_of(packed, "ETag");
  CHECK(tag != value_of(plain, "ETag"));
  for (const std::string& known : {tag, "W/" + tag, "\"other\", " + tag, std::string("*")}) {
    INFO(known);
    const std::string again =
        asked(bench, "/assets/page.js", reads_gzip + "If-None-Match: " + known + "\r\n");
    CHECK(test::status_of(again) == 304);
    CHECK(value_of(again, "ETag") == tag);
    CHECK(body_of(again).empty());
  }
  CHECK(test::status_of(asked(bench, "/assets/page.js", "If-None-Match: " + tag + "\r\n")) == 200);
  const std::string head = asked(bench, "/assets/page.js", reads_gzip, "HEAD");
  CHECK(test::status_of(head) == 200);
  CHECK(value_of(head, "Content-Length") == std::to_string(body_of(packed).size()));
  CHECK(body_of(head).empty());
}

TEST_CASE("the page with its script, styles and one language has 60 kB on its way to a browser") {
  if (host::web_files().empty()) return;
  std::size_t bytes = 0;
  for (const char* name : {"index.html", "page.js", "page.css", "de.json", "icon.svg"}) {
    INFO(name);
    const host::WebFile* file = host::web_file(name);
    REQUIRE(file);
    bytes += file->packed.size();
  }
  CAPTURE(bytes);
  CHECK(bytes <= 60'000);
}

TEST_CASE("no path leads out of the page's files") {
  DaemonBench bench;
  bench.folder().write("secret.txt", "secret");
  std::filesystem::create_directory(bench.path("web"));
  bench.folder().write("web/index.html", "<!doctype html>mine");
  bench.folder().write("web/.hidden", "secret");
  std::filesystem::create_directory(bench.path("web/folder"));
  bench.serve({"--web-folder", bench.path("web")});
  CHECK(body_of(asked(bench, "/")) == "<!doctype html>mine");
  bench.folder().write("web/index.html", "<!doctype html>changed");
  CHECK(body_of(asked(bench, "/")) == "<!doctype html>changed");
  for (const char* path :
       {"/assets/../secret.txt", "/assets/%2e%2e/secret.txt", "/assets/..%2fsecret.txt", "/assets/.hidden",
        "/assets/..\\secret.txt", "/assets//secret.txt", "/assets/", "/assets/folder", "/assets/nothing",
        "/assets/folder/../../secret.txt", "/assets/./index.html", "/index.html"}) {
    INFO(path);
    const std::string answer = asked(bench, path);
    CHECK(
        (test::status_of(answer) == 400 || test::status_of(answer) == 404 || test::status_of(answer) == 401));
    CHECK(body_of(answer).find("secret\n") == std::string::npos);
    CHECK(answer.find("mine") == std::string::npos);
  }
  CHECK(test::status_of(asked(bench, "/", "Content-Length: 0\r\n", "POST")) == 405);
}
