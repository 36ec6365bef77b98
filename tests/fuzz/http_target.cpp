#include "tests/fuzz/http_target.hpp"

#include <asio/io_context.hpp>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "core/error.hpp"
#include "host/daemon/api.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/http/form_reader.hpp"
#include "host/http/http_server.hpp"
#include "tests/fuzz/damage.hpp"
#include "tests/host/support/raw_http.hpp"
#include "tests/host/support/sample_job.hpp"

namespace unicursal::test {
namespace {

namespace fs = std::filesystem;
using namespace host;

/// A daemon without a printer, on a thread of its own until the program ends.
class Target {
 public:
  explicit Target(const fs::path& folder) : folder_(prepared(folder)), state_(folder_ / "state") {
    AccessRules rules{std::string(64, 'f'), std::string(64, 'm'), {}};
    rules.hosts = hosts_for("127.0.0.1", server_.endpoint().port(), {});
    token_ = *rules.token;
    api_.set_rules(std::move(rules));
    thread_ = std::thread([this] { loop_.run(); });
  }
  ~Target() {
    loop_.stop();
    thread_.join();
  }

  int port() { return server_.endpoint().port(); }
  const std::string& token() const { return token_; }
  bool nothing_strange() const {
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename();
      if (name != "state" && name != "jobs" && name != "secret.toml") return false;
    }
    return true;
  }

 private:
  static fs::path prepared(const fs::path& folder) {
    fs::remove_all(folder / "http");
    fs::create_directories(folder / "http/jobs");
    std::ofstream(folder / "http/jobs/plate.toml") << sample_job;
    std::ofstream(folder / "http/jobs/bench.toml") << sample_profile;
    std::ofstream(folder / "http/secret.toml") << sample_job;
    return folder / "http";
  }
  static DaemonOptions options(const fs::path& folder) {
    DaemonOptions options;
    options.state = folder / "state";
    options.jobs = {folder / "jobs"};
    options.port = "/nowhere";
    options.spool = folder / "state/spool";
    return options;
  }

  fs::path folder_;
  StateFolder state_;
  asio::io_context loop_{1};
  Daemon daemon_{loop_, options(folder_)};
  Api api_{daemon_};
  HttpServer server_{loop_, parse_endpoint("127.0.0.1:0"), api_};
  std::string token_;
  std::thread thread_;
};

std::string pick(core::Random& random, std::initializer_list<const char*> words) {
  return words.begin()[random.below(words.size())];
}

std::string noise(core::Random& random, std::size_t most) {
  std::string bytes(random.below(most), ' ');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
  return bytes;
}

const std::string boundary = "------------------------4ebf00fbcf09";

std::string slicers_form(core::Random& random) {
  const auto part = [](const std::string& disposition, const std::string& content) {
    return "--" + boundary + "\r\nContent-Disposition: form-data; " + disposition + "\r\n\r\n" + content +
           "\r\n";
  };
  const std::string name =
      pick(random, {"a.svg", "../../b.svg", "c.gcode", "W\xc3\xbcrfel (2).stl", "d.toml", ""});
  return part("name=\"print\"", pick(random, {"true", "false", ""})) + part("name=\"path\"", "") +
         part("name=\"file\"; filename=\"" + name + "\"", damaged(sample_drawing, random)) + "--" + boundary +
         "--\r\n";
}

std::string body(core::Random& random) {
  switch (random.below(5)) {
    case 4:
      return slicers_form(random);
    case 0:
      return damaged(R"({"job": "plate.toml", "layers": [0, 1]})", random);
    case 1:
      return damaged(R"({"job": "upload:a/../../../secret.toml", "id": 1, "percent": 1e9})", random);
    case 2:
      return noise(random, 3000);
    default:
      return std::string(random.below(100000), random.below(2) == 0 ? '[' : 'a');
  }
}

std::string request(Target& target, core::Random& random, bool known) {
  const std::string content = body(random);
  std::string text = pick(random, {"GET", "POST", "PUT", "DELETE", "OPTIONS", "CONNECT"}) + " " +
                     pick(random, {"/api/status",
                                   "/api/jobs",
                                   "/api/jobs/1",
                                   "/api/files/a/b.toml",
                                   "/metrics",
                                   "/api/print/start",
                                   "/api/print/stop",
                                   "/api/events",
                                   "/../../etc/passwd",
                                   "/api/files/../x",
                                   "/api/temperature",
                                   "/api/speed",
                                   "/api/printer",
                                   "/api/files/local",
                                   "/api/files/local/a.svg",
                                   "/api/job",
                                   "/api/connection",
                                   "/api/login",
                                   "/api/keys",
                                   "/api/bed"}) +
                     " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(target.port()) + "\r\n";
  if (known) text += "Authorization: Bearer " + target.token() + "\r\n";
  if (random.below(3) == 0)
    text += pick(random, {"Origin: http://evil.example\r\n", "Expect: 100-continue\r\n",
                          "Transfer-Encoding: chunked\r\n", "Connection: close\r\n", "Content-Length: 7\r\n",
                          "Authorization: Bearer x\r\n"});
  if (random.below(4) == 0)
    text +=
        "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  if (content.starts_with("--"))
    text += "Content-Type: multipart/form-data; boundary=" + boundary + "\r\n";
  else
    text += pick(random, {"Content-Type: application/json\r\n", "Content-Type: text/plain\r\n", ""});
  return text + "Content-Length: " + std::to_string(content.size()) + "\r\n\r\n" + content;
}

void check_answer(const std::string& answer, bool known) {
  if (answer.empty()) return;
  const int status = status_of(answer);
  if (status < 100 || status > 599) throw std::runtime_error("an answer that is not HTTP");
  if (status >= 500 && status != 503 && status != 505 && status != 507)
    throw std::runtime_error("an answer of " + std::to_string(status) + ": " + answer);
  if (!known && status < 400) throw std::runtime_error("a stranger was answered: " + answer);
}

void check_alive(Target& target) {
  RawConnection sound(target.port());
  sound.send("GET /api/status HTTP/1.1\r\nHost: localhost:" + std::to_string(target.port()) +
             "\r\nConnection: close\r\nAuthorization: Bearer " + target.token() + "\r\n\r\n");
  if (status_of(sound.read_all()) != 200) throw std::runtime_error("the daemon serves no more");
  if (!target.nothing_strange()) throw std::runtime_error("a file was made elsewhere");
}

/// What a reader finds, or how it refuses, as one text.
std::string found(const std::string& bytes, core::Random* random) {
  class Taker final : public FormTaker {
   public:
    std::string all;
    void begin(const FormPart& part) override {
      all += "[" + part.name + "|" + part.filename.value_or("-") + "|";
    }
    void take(std::string_view piece) override { all += piece; }
    void end() override { all += "]"; }
  };
  Taker taker;
  FormReader reader(boundary, taker);
  try {
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = random ? 1 + random->below(random->below(10) == 0 ? 1000 : 4) : bytes.size();
      reader.add(std::string_view(bytes).substr(at, size));
      at += size;
    }
    reader.finish();
  } catch (const HttpError& refused) {
    taker.all += std::to_string(refused.status());
  }
  return taker.all;
}

}  // namespace

void form(const std::filesystem::path& folder, core::Random& random) {
  fs::create_directories(folder);
  std::string bytes = slicers_form(random);
  if (random.below(4) != 0) bytes = damaged(bytes, random);
  std::ofstream(folder / "form", std::ios::binary) << bytes;
  const std::string whole = found(bytes, nullptr);
  if (found(bytes, &random) != whole) throw std::runtime_error("pieces make another form");
  if (!whole.ends_with("]")) throw core::DataError("", "", "refused", "");
}

void http(const std::filesystem::path& folder, core::Random& random) {
  static Target target(folder);
  const bool known = random.below(2) == 0;
  std::string bytes = random.below(20) == 0 ? noise(random, 40000) : request(target, random, known);
  if (random.below(3) != 0) bytes = damaged(bytes, random);
  if (random.below(4) == 0) bytes += noise(random, 300);  // frames, or a second request
  std::string answer;
  {
    RawConnection connection(target.port());
    const std::size_t cut = random.below(bytes.size() + 1);
    connection.send(bytes.substr(0, cut));
    connection.send(bytes.substr(cut));
    if (random.below(8) != 0) {  // otherwise the client leaves without reading
      connection.finish_sending();
      answer = connection.read_all();
    }
  }
  check_answer(answer, known);
  if (random.below(50) == 0) check_alive(target);
  if (status_of(answer) == 0 || status_of(answer) >= 400) throw core::DataError("", "", "refused", "");
}

}  // namespace unicursal::test
