// The daemon with a simulated printer and clients, and the ways in which it ends: real processes and sockets.
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;
using test::Outcome;
using test::RawConnection;

namespace {

int add(const DaemonBench& bench, const std::string& layers = "0:0") {
  const Outcome added = bench.command({"queue", "--add", "plate.toml", "--layers", layers});
  INFO(added.err);
  REQUIRE(added.code == 0);
  return std::stoi(added.out);
}

json job(const DaemonBench& bench, int id) {
  return bench.ask("GET", "/api/jobs/" + std::to_string(id));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The place of the last occurrence.
std::size_t last(const std::string& text, const std::string& part) {
  INFO(part);
  REQUIRE(text.find(part) != std::string::npos);
  return text.rfind(part);
}

RawConnection& listen_to_events(RawConnection& connection, const DaemonBench& bench) {
  connection.send("GET /api/events HTTP/1.1\r\nHost: " + bench.host() + "\r\nAuthorization: Bearer " +
                  bench.token() +
                  "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                  "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  return connection;
}

}  // namespace

TEST_CASE("two jobs are printed one after the other, each when it is started") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve();
  const int first = add(bench, "0:1"), second = add(bench);
  REQUIRE(bench.command({"start"}).code == 0);
  CHECK(bench.status(bench.request("POST", "/api/print/start")) == 409);  // one at a time
  CHECK(bench.status(bench.request("DELETE", "/api/jobs/" + std::to_string(first))) == 409);
  bench.await_job(first, "done");
  CHECK(job(bench, second)["state"] == "queued");  // never by itself
  REQUIRE(bench.command({"start", std::to_string(second)}).code == 0);
  bench.await_job(second, "done");
  const std::string lines = bench.transcript();
  CHECK(count(lines, "G28") >= 2);
  CHECK(lines.find("M104 S0") != std::string::npos);
  const Outcome status = bench.command({"status"});
  CHECK(status.out.find("idle; 0 waiting") == 0);
}

TEST_CASE("a print is paused and steered by the daemon's commands") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const int id = add(bench, "0:1999");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_print("printing");
  REQUIRE(bench.command({"pause"}).code == 0);
  bench.await_print("paused");
  CHECK(bench.command({"pause"}).code != 0);
  CHECK(bench.status(bench.request("POST", "/api/speed", "{\"percent\": 5}")) == 409);
  for (const char* wrong : {"{\"nozzle_c\": 206, \"bed_c\": 999}", "{\"nozzle_c\": 999, \"bed_c\": 56}"})
    CHECK(bench.status(bench.request("POST", "/api/temperature", wrong)) == 409);
  CHECK(bench.status(bench.request("POST", "/api/speed", "{\"percent\": 150}")) == 202);
  CHECK(bench.status(bench.request("POST", "/api/temperature", "{\"nozzle_c\": 205, \"bed_c\": 55}")) == 202);
  const Outcome changed = bench.command({"set", "--flow", "95", "--nozzle", "207", "--bed", "57"});
  CHECK(changed.out.find("flow 95 %") != std::string::npos);
  CHECK(bench.command({"set", "--flow", "5"}).code == 2);
  CHECK(bench.command({"set"}).code == 2);
  CHECK(bench.send(bench.request("GET", "/metrics")).find("\nunicursal_paused 1\n") != std::string::npos);
  REQUIRE(bench.command({"resume"}).code == 0);  // the daemon's print, not a kept one
  bench.await_print("printing");
  REQUIRE(bench.command({"cancel"}).code == 0);
  bench.await_job(id, "stopped");
  const std::string log = bench.daemon().err();
  for (const char* line : {"POST /api/jobs: done\n", "job 1 plate.toml: printing\n", "print: heating",
                           "POST /api/print/pause: done\n", "POST /api/speed: refused: ",
                           "POST /api/temperature: refused: ", "job 1 plate.toml: stopped: "})
    CHECK(count(log, line) >= 1);
  CHECK(log.find("GET ") == std::string::npos);
  const std::string lines = bench.transcript();
  for (const char* line : {"M220 S150", "M104 S205", "M140 S55", "M221 S95", "M104 S207", "M140 S57"})
    CHECK(lines.find(line) != std::string::npos);
  CHECK(lines.find("M104 S206") == std::string::npos);  // both or neither
  CHECK(lines.find("M140 S56") == std::string::npos);
  CHECK(last(lines, "M104 S0") > last(lines, "M104 S207"));  // cold in the end
  CHECK(last(lines, "M140 S0") > last(lines, "M140 S57"));
}

TEST_CASE("a question of the daemon's printer is shown in its status, and answered by command and by API") {
  DaemonBench bench;
  bench.start_printer("100", {"--personality", "marlin-host", "--fault", "filamentchange@line=300"});
  bench.serve();
  CHECK(bench.command({"answer", "0"}).err.find("nothing is being printed") != std::string::npos);
  const int id = add(bench, "0:0");
  REQUIRE(bench.command({"start"}).code == 0);
  const auto asks = [&](const std::string& text) {
    await(
        [&] {
          const nlohmann::json print =
              bench.ask("GET", "/api/status").value("print", nlohmann::json::object());
          return print.contains("prompt") && print["prompt"]["text"] == text && print["state"] == "paused";
        },
        bench.daemon());
  };
  asks("Nozzle Parked");
  CHECK(bench.command({"status"}).out.find("  unicursal answer 0: Continue\n") != std::string::npos);
  CHECK(bench.command({"answer", "ten"}).code == 2);
  CHECK(bench.command({"answer", "9"}).err.find("is not one of its answers") != std::string::npos);
  CHECK(bench.status(bench.request("POST", "/api/print/answer", "{}")) == 400);
  CHECK(bench.status(bench.request("POST", "/api/print/answer", "{\"button\": -1}")) == 400);
  CHECK(bench.status(bench.request("POST", "/api/print/answer", "{\"button\": 4294967296}")) == 409);
  REQUIRE(bench.command({"answer", "0"}).code == 0);
  asks("Paused");
  CHECK(bench.status(bench.request("POST", "/api/print/answer", "{\"button\": 1}")) == 202);
  bench.await_job(id, "done");
  CHECK(bench.status(bench.request("POST", "/api/print/answer", "{\"button\": 1}")) == 409);
}

TEST_CASE("clients come and go without disturbing the print") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const int id = add(bench, "0:4");
  RawConnection stays(bench.port());
  CHECK(listen_to_events(stays, bench).read_until("\r\n\r\n").find(" 101 ") != std::string::npos);
  {
    RawConnection goes(bench.port());
    listen_to_events(goes, bench).read_until("\"hello\"");
    REQUIRE(bench.command({"start"}).code == 0);
    goes.read_until("\"progress\"");
  }
  RawConnection mute(bench.port());  // upgrades, and never reads
  listen_to_events(mute, bench);
  bench.await_job(id, "done");
  const std::string heard = stays.read_until("\"done\"");
  for (const char* word :
       {"\"hello\"", "\"preparing\"", "\"heating\"", "\"printing\"", "\"progress\"", "\"percent\""})
    CHECK(heard.find(word) != std::string::npos);
}

TEST_CASE("a daemon that is killed finds its queue again") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const int first = add(bench, "0:1999"), second = add(bench);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_print("printing");
  kill(bench.daemon().id(), SIGKILL);
  bench.daemon().wait();
  CHECK(bench.command({"status"}).code == 2);  // nobody answers at the address that it left behind
  bench.serve();
  CHECK(job(bench, first)["state"] == "interrupted");
  CHECK(job(bench, first)["reason"].get<std::string>().find("unicursal resume") != std::string::npos);
  CHECK(job(bench, second)["state"] == "queued");
  CHECK(add(bench) == second + 1);
}

TEST_CASE("the print of a killed daemon can be continued") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  add(bench, "0:4");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_laying();
  kill(bench.daemon().id(), SIGKILL);
  bench.daemon().wait();
  const Outcome resumed = test::run({"resume", "--spool", bench.path("spool"), "--yes"});
  INFO(resumed.err);
  CHECK(resumed.code == 0);
  const std::string lines = bench.transcript();
  CHECK(lines.find("M85 S1800") <
        lines.find("M104 S2"));       // the firmware cools the printer if nobody continues
  CHECK(count(lines, "G28\n") == 1);  // the printer had not lost its place
  CHECK(last(lines, "M104 S0") > last(lines, "G1 "));
}

TEST_CASE("two daemons, and a print beside them, do not share a port") {
  DaemonBench bench, other;
  bench.start_printer("100");
  bench.serve();
  add(bench, "0:1999");
  other.serve_at(bench.path("port"));
  const int late = add(other);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_print("printing");
  CHECK(other.command({"start"}).code == 1);
  CHECK(job(other, late)["state"] == "queued");
  CHECK(job(other, late)["reason"].get<std::string>().find("is using it; close that program first") !=
        std::string::npos);
  const Outcome print = test::run({"print", bench.path("jobs/plate.toml"), "--port", bench.path("port"),
                                   "--spool", bench.path("spool2")});
  CHECK(print.code != 0);
  CHECK(print.err.find("is using it; close that program first") != std::string::npos);
  CHECK(bench.command({"serve", "--listen", "127.0.0.1:0"}).err.find("another daemon") != std::string::npos);
  CHECK(bench.print_state() == "printing");
}

TEST_CASE("a job that does not fit on the disk is refused, and nothing else is lost") {
  DaemonBench bench;
  bench.serve();
  const int first = add(bench);
  const std::string kept = test::read_text(bench.path("state/queue.json"));
  const rlimit full{kept.size(), RLIM_INFINITY}, room{RLIM_INFINITY, RLIM_INFINITY};
  REQUIRE(prlimit(bench.daemon().id(), RLIMIT_FSIZE, &full, nullptr) == 0);
  const std::string one = "{\"job\": \"plate.toml\"}";
  CHECK(bench.status(bench.request("POST", "/api/jobs", one)) == 507);
  CHECK(bench.status(bench.request("PUT", "/api/files/a/b.svg", std::string(5000, ' '))) == 507);
  CHECK(bench.ask("GET", "/api/jobs")["jobs"].size() == 1);
  CHECK(test::read_text(bench.path("state/queue.json")) == kept);
  const rlimit fuller{10, RLIM_INFINITY};
  REQUIRE(prlimit(bench.daemon().id(), RLIMIT_FSIZE, &fuller, nullptr) == 0);
  CHECK(bench.status(bench.request("DELETE", "/api/jobs/" + std::to_string(first))) == 507);
  CHECK(bench.ask("GET", "/api/jobs")["jobs"].size() == 1);
  CHECK_FALSE(std::filesystem::exists(bench.path("state/queue.json.part")));
  CHECK_FALSE(std::filesystem::exists(bench.path("state/files/a/b.svg.part")));
  REQUIRE(prlimit(bench.daemon().id(), RLIMIT_FSIZE, &room, nullptr) == 0);
  CHECK(add(bench) > first);
}

TEST_CASE("an upload does not change under a print") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  bench.folder().write("plate.svg", test::sample_drawing);
  bench.folder().write("bench.toml", test::tall_profile());
  bench.folder().write("own.toml", test::tall_job());
  REQUIRE(bench.command({"queue", "--upload", bench.path("own.toml")}).code == 0);
  REQUIRE(bench.command({"start"}).code == 0);
  CHECK(bench.status(bench.request("PUT", "/api/files/own/own.toml", test::sample_job)) == 409);
  CHECK(bench.status(bench.request("DELETE", "/api/files/own")) == 409);
  CHECK(bench.status(bench.request("PUT", "/api/files/ow/own.toml", test::sample_job)) == 201);
}

TEST_CASE("SIGTERM, SIGHUP and SIGQUIT park and cool the print before the daemon ends") {
  const int signal = GENERATE(SIGTERM, SIGHUP, SIGQUIT);
  CAPTURE(signal);
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const int id = add(bench, "0:1999");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_laying();
  for (const int idle : {SIGUSR1, SIGUSR2, SIGTSTP, SIGALRM}) kill(bench.daemon().id(), idle);
  CHECK(bench.print_state() == "printing");
  kill(bench.daemon().id(), signal);
  if (signal == SIGHUP) kill(bench.daemon().id(), signal);  // as a closed terminal does
  CHECK(bench.daemon().wait().code == 0);
  const std::string lines = bench.transcript();
  CHECK(last(lines, "M104 S0") > last(lines, "G1 "));
  CHECK(last(lines, "M140 S0") > last(lines, "G1 "));
  bench.serve();
  CHECK(job(bench, id)["state"] == "stopped");
  CHECK(job(bench, id)["reason"].get<std::string>().find("the daemon was asked to end") == 0);
}

TEST_CASE("stop is M112, and the job has failed") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const int id = add(bench, "0:1999");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_print("printing");
  REQUIRE(bench.command({"stop"}).code == 0);
  bench.await_job(id, "failed");
  CHECK(job(bench, id)["reason"].get<std::string>().find("stopped at once") == 0);
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
}

TEST_CASE("a job whose printer is off stays in the queue") {
  DaemonBench bench;
  bench.serve();
  const int id = add(bench);
  const std::string answer = bench.send(bench.request("POST", "/api/print/start"));
  CHECK(test::status_of(answer) == 409);
  CHECK(answer.find("switch it on") != std::string::npos);
  CHECK(job(bench, id)["state"] == "queued");
  bench.folder().write("port", "no printer");  // opens, and is not a serial port
  CHECK(bench.command({"start"}).code == 1);
  CHECK(job(bench, id)["state"] == "queued");
  CHECK_FALSE(job(bench, id)["reason"].get<std::string>().empty());
  std::filesystem::remove(bench.path("port"));
  bench.start_printer("0");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_job(id, "done");
}

TEST_CASE("a job that cannot be printed has a reason, and the next one is printed") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve();
  std::filesystem::remove(bench.path("jobs/plate.svg"));
  const int broken = add(bench);
  const Outcome started = bench.command({"start"});
  CHECK(started.code == 1);
  CHECK(started.out.find("plate.svg") != std::string::npos);
  CHECK(job(bench, broken)["state"] == "failed");
  bench.folder().write("jobs/plate.svg", test::sample_drawing);
  const int sound = add(bench);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_job(sound, "done");
}

TEST_CASE("a queued job is printed as it was, although another job of its name is uploaded later") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve();
  bench.folder().write("plate.svg", test::sample_drawing);
  bench.folder().write("bench.toml", test::sample_profile);
  bench.folder().write("own.toml", test::sample_job);
  CHECK(bench.command({"queue", "--upload", bench.path("own.toml")}).out == "1 upload:own/own.toml\n");
  bench.folder().write("own.toml", test::replaced(test::sample_job, "flow = 3.0", "flow = 1.0"));
  CHECK(bench.command({"queue", "--upload", bench.path("own.toml")}).out == "2 upload:own-2/own.toml\n");
  CHECK(test::read_text(bench.path("state/files/own/own.toml")) == test::sample_job);
  CHECK(bench.status(bench.request("PUT", "/api/files/own/own.toml", "x")) == 409);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_job(1, "done");
  CHECK(bench.ask("GET", "/api/status")["last"]["job"]["state"] == "done");
  CHECK(bench.status(bench.request("PUT", "/api/files/own/own.toml", "x")) == 201);
}

TEST_CASE("a user's own job is uploaded with its files") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve();
  bench.folder().write("plate.svg", test::sample_drawing);
  bench.folder().write("bench.toml", test::sample_profile);
  const Outcome sent = bench.command({"queue", "--upload", bench.path("secret.toml"), "--layers", "0:0"});
  INFO(sent.err);
  REQUIRE(sent.code == 0);
  CHECK(sent.out == "1 upload:secret/secret.toml\n");
  CHECK(test::read_text(bench.path("state/files/secret/plate.svg")) == test::sample_drawing);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_job(1, "done");
  bench.folder().write("far.toml", test::replaced(test::sample_job, "plate.svg", "jobs/plate.svg"));
  CHECK(bench.command({"queue", "--upload", bench.path("far.toml")}).code == 2);
}

TEST_CASE("a model is queued like a job, and printed with the daemon's profile") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve({"--profile", bench.path("jobs/bench.toml.profile")});
  bench.folder().write("plate.svg", test::sample_drawing);
  bench.folder().write("jobs/own.svg", test::sample_drawing);
  bench.folder().write("jobs/empty.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/>");
  CHECK(bench.command({"queue", "--jobs"}).out.find("own.svg") != std::string::npos);
  const Outcome sent = bench.command({"queue", "--upload", bench.path("plate.svg"), "--layers", "0:0"});
  INFO(sent.err);
  REQUIRE(sent.code == 0);
  CHECK(sent.out == "1 upload:plate/plate.svg\n");
  REQUIRE(bench.command({"queue", "--add", "own.svg", "--layers", "0:0"}).code == 0);
  const Outcome empty = bench.command({"queue", "--add", "empty.svg"});
  CHECK(empty.code == 2);
  CHECK(empty.err.find("holds no area") != std::string::npos);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_job(1, "done");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_job(2, "done");
}

TEST_CASE("names of files do not command the terminal, and stay legible") {
  DaemonBench bench;
  bench.folder().write(
      "jobs/a\x1b[31m\xc2\x9b"
      "b\x7f.toml",
      "");
  bench.folder().write("jobs/caf\xc3\xa9.toml", "");
  bench.serve();
  const std::string words = bench.command({"queue", "--jobs"}).out;
  CHECK(count(words, "a\\x1b[31m\\xc2\\x9bb\\x7f.toml\n") == 1);
  CHECK(count(words, "caf\xc3\xa9.toml\n") == 1);
  const std::string text = bench.command({"queue", "--jobs", "--json"}).out;
  for (const char* raw : {"\x1b", "\xc2\x9b", "\x7f"}) CHECK(count(words + text, raw) == 0);
  const json names = json::parse(text)["jobs"];
  CHECK(std::find(names.begin(), names.end(),
                  "a\x1b[31m\xc2\x9b"
                  "b\x7f.toml") != names.end());
}

TEST_CASE("systemd gets messages: ready, alive, stopping") {
  DaemonBench bench;
  const std::string path = bench.path("notify");
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int heard = socket(AF_UNIX, SOCK_DGRAM, 0);
  REQUIRE(bind(heard, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  const timeval patience{60, 0};
  setsockopt(heard, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  const auto next = [heard] {
    char text[512];
    const ssize_t size = recv(heard, text, sizeof text, 0);
    return std::string(text, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  };
  setenv("NOTIFY_SOCKET", path.c_str(), 1);
  setenv("WATCHDOG_USEC", "200000", 1);
  bench.serve();
  unsetenv("NOTIFY_SOCKET");
  unsetenv("WATCHDOG_USEC");
  CHECK(next().find("READY=1") == 0);
  CHECK(next() == "WATCHDOG=1");
  kill(bench.daemon().id(), SIGTERM);
  std::string last = next();
  while (last == "WATCHDOG=1") last = next();
  CHECK(last.find("STOPPING=1") == 0);
  CHECK(last.find("EXTEND_TIMEOUT_USEC") == std::string::npos);  // nothing is to be parked
  CHECK(bench.daemon().wait().code == 0);
  close(heard);
}

TEST_CASE("an upload that was swapped after its job had ended is read by a child again") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve({"--check-time", "5"});
  bench.folder().write("plate.svg", test::sample_drawing);
  bench.folder().write("bench.toml", test::sample_profile);
  bench.folder().write("own.toml", test::sample_job);
  REQUIRE(bench.command({"queue", "--upload", bench.path("own.toml")}).code == 0);
  REQUIRE(bench.command({"start"}).code == 0);
  const int id = bench.ask("GET", "/api/jobs")["jobs"][0]["id"];
  bench.await_job(id, "done");
  // A drawing that does not end within the limit of time.
  std::string circles =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"100mm\" "
      "viewBox=\"0 0 100 100\">";
  for (int i = 0; i < 20000; ++i) {
    if (i == 19000) circles += "<rect fill=\"#0000ff\" width=\"90\" height=\"90\"/>";
    circles += "<circle fill=\"red\" cx=\"" + std::to_string(20 + i % 61) + "\" cy=\"" +
               std::to_string(20 + i % 59) + "\" r=\"" + std::to_string(5 + i % 13) + "\"/>";
  }
  REQUIRE(bench.status(bench.request("PUT", "/api/files/own/plate.svg", circles + "</svg>")) == 201);
  CHECK(bench.command({"start", std::to_string(id)}).code == 1);
  bench.await_job(id, "failed");
  CHECK(bench.daemon().running());
  CHECK(job(bench, id)["reason"].get<std::string>().find("time") != std::string::npos);
}

TEST_CASE("an upload is refused with the notes of its reader, behind the refusal") {
  DaemonBench bench;
  bench.serve();
  bench.folder().write(
      "lines.svg",
      "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='16mm' viewBox='0 0 20 16'>"
      "<rect id='cut' width='9' height='9' fill='none' stroke='red' stroke-width='0.1'/></svg>");
  bench.folder().write("bench.toml", test::sample_profile);
  const std::string job = test::replaced(test::sample_job, "plate.svg", "lines.svg");
  const Outcome refused =
      bench.command({"queue", "--upload", bench.folder().write("job.toml", job).string()});
  INFO(refused.err);
  CHECK(refused.code == 2);
  CHECK(count(refused.err, "unicursal: ") == 1);
  CHECK(count(refused.err, "\n") == 1);
  CHECK(refused.err.find("note: ") == std::string::npos);
  const auto refusal = refused.err.find("outline = \"strokes\" in [part] if they are contours"),
             note = refused.err.find("(noted before: line 1: <rect id=\"cut\">");
  REQUIRE(note != std::string::npos);
  CHECK(refusal < note);
}
