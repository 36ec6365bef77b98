// The daemon's idle printer, its profile and its examination, over HTTP against a simulated printer.
#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;

namespace {

class IdleDaemon : public DaemonBench {
 public:
  explicit IdleDaemon(const std::string& speed = "200", const std::vector<std::string>& more = {},
                      const std::vector<std::string>& of_daemon = {}) {
    start_printer(speed, more);
    std::vector<std::string> options{"--profile", path("jobs/bench.toml.profile")};
    options.insert(options.end(), of_daemon.begin(), of_daemon.end());
    serve(options);
  }
  json printer() const { return ask("GET", "/api/printer"); }
  int post(const std::string& what, const std::string& body = "{}") const {
    return status(request("POST", "/api/printer/" + what, body));
  }
  void until(const std::function<bool(const json&)>& so) {
    test::await([&] { return so(printer()); }, daemon());
  }
  void connect() {
    REQUIRE(post("connect") == 202);
    until([](const json& now) { return now["connection"] == "open" && now["nozzle"].contains("actual_c"); });
  }
};

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("a print takes the port over from the idle printer, and gives it back", "[optimised]") {
  IdleDaemon bench;
  bench.connect();
  REQUIRE(bench.post("heat", R"({"nozzle_c": 150})") == 202);
  REQUIRE(bench.post("home") == 202);
  bench.until([](const json& now) { return now["homed"] == true; });
  REQUIRE(bench.command({"queue", "--add", "plate.toml", "--layers", "0:0"}).code == 0);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.until([](const json& now) { return now["connection"] == "printing"; });
  for (const char* command : {"connect", "disconnect", "home", "cancel"}) CHECK(bench.post(command) == 409);
  CHECK(bench.post("heat", R"({"nozzle_c": 150})") == 409);
  CHECK(bench.post("feed", R"({"action": "purge"})") == 409);
  CHECK(bench.status(bench.request("POST", "/api/doctor", "{}")) == 409);
  bench.await_job(1, "done");
  bench.until([](const json& now) { return now["connection"] == "open" && now["homed"] == false; });
  const json heat = bench.ask("GET", "/api/temperatures")["rows"];
  CHECK(heat.size() >= 1);
  CHECK(bench.post("disconnect") == 202);
  bench.until([](const json& now) { return now["connection"] == "closed"; });
  CHECK(occurrences(bench.transcript(), "M115") == 3);
}

TEST_CASE("commands to an idle printer are refused with a reason, whoever sends them") {
  IdleDaemon bench("50");
  CHECK(bench.post("heat", R"({"nozzle_c": 150})") == 409);  // it is closed
  bench.connect();
  CHECK(bench.post("connect") == 202);  // a second client: it is open
  for (const char* body :
       {R"({"nozzle_c": 301})", R"({"bed_c": 121})", R"({"nozzle_c": -1})", R"({"nozzle_c": 1e300})"})
    CHECK(bench.post("heat", body) == 422);
  const std::string said = bench.ask("GET", "/api/log").dump();
  CHECK(said.find("FIRMWARE_NAME") != std::string::npos);
  CHECK(said.find("\"printer\"") != std::string::npos);
  CHECK(bench.ask("POST", "/api/printer/move", R"({"x": 1})")["code"] == "not_homed");
  for (const char* body : {R"({"nozzle_c": "hot"})", R"({"nozzle_c": [1]})", R"({"nozle_c": 1})", "{}", "[]",
                           R"({"nozzle_c": NaN})", R"({"nozzle_c": 1e999})"})
    CHECK(bench.post("heat", body) == 400);
  CHECK(bench.post("home", R"({"axes": ["w"]})") == 400);
  CHECK(bench.post("home", R"({"axes": ["z"]})") == 409);
  CHECK(bench.post("move", R"({"x": 1})") == 409);
  CHECK(bench.post("fan", R"({"percent": 101})") == 422);
  CHECK(bench.post("feed", R"({"action": "eat"})") == 400);
  CHECK(bench.post("feed", R"({"action": "load", "feeder": 0})") == 422);
  CHECK(bench.post("feed", R"({"action": "load", "feeder": 4})") == 422);
  CHECK(bench.post("feed", R"({"action": "load", "feeder": 1, "length": 1e9})") == 422);
  CHECK(bench.status(bench.request("POST", "/api/printer/connect", R"({"port": "/etc/passwd"})")) == 409);
}

TEST_CASE("a pulled cable closes the connection with a reason, and the printer comes back cold",
          "[optimised]") {
  IdleDaemon bench("50", {"--fault", "disconnect:100@t=200"});
  bench.connect();
  REQUIRE(bench.post("heat", R"({"nozzle_c": 200, "bed_c": 60})") == 202);
  bench.until([](const json& now) { return now["connection"] == "closed"; });
  CHECK(bench.printer()["problem"].get<std::string>().find("connection to the printer was lost") !=
        std::string::npos);
  bench.until([](const json& now) {
    return now["connection"] == "open" && now["nozzle"].value("target_c", 1.0) == 0 &&
           now["bed"].value("target_c", 1.0) == 0;
  });
}

TEST_CASE("an examination does not end the search for a hot printer whose cable is out", "[optimised]") {
  IdleDaemon bench("50", {"--fault", "disconnect:40@command=M106"});
  bench.connect();
  REQUIRE(bench.post("heat", R"({"nozzle_c": 200, "bed_c": 60})") == 202);
  bench.until([](const json& now) { return now["bed"].value("target_c", 0.0) == 60; });
  REQUIRE(bench.post("fan", R"({"percent": 50})") == 202);
  bench.until([](const json& now) { return now["connection"] == "closed"; });
  const json refused = bench.ask("POST", "/api/doctor", "{}");
  CHECK(refused["code"] == "not_examined");
  bench.until([](const json& now) {
    return now["connection"] == "open" && now["nozzle"].value("target_c", 1.0) == 0 &&
           now["bed"].value("target_c", 1.0) == 0;
  });
  const std::string lines = bench.transcript();
  CHECK(lines.rfind("M104 S0") > lines.rfind("M104 S200"));
}

TEST_CASE("a hot printer whose cable is pulled before the print begins is found again and cooled",
          "[optimised]") {
  IdleDaemon bench("50", {"--fault", "disconnect:40@command=M163"});  // the print's first question
  bench.connect();
  REQUIRE(bench.post("heat", R"({"nozzle_c": 150, "bed_c": 60})") == 202);
  bench.until([](const json& now) {
    return now["nozzle"].value("target_c", 0.0) == 150 && now["bed"].value("target_c", 0.0) == 60;
  });
  REQUIRE(bench.command({"queue", "--add", "plate.toml", "--layers", "0:0"}).code == 0);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.until([](const json& now) { return now["connection"] == "closed" && now.contains("doing"); });
  CHECK(bench.ask("GET", "/api/jobs/1")["state"] == "queued");
  bench.until([](const json& now) {
    return now["connection"] == "open" && now["nozzle"].value("target_c", 1.0) == 0 &&
           now["bed"].value("target_c", 1.0) == 0;
  });
  const json lines = bench.ask("GET", "/api/log")["lines"];
  CHECK(std::any_of(lines.begin(), lines.end(), [](const json& line) {
    return line["from"] == "notice" &&
           line["text"].get<std::string>().find("heaters were switched off") != std::string::npos;
  }));
}

TEST_CASE("a kept print goes on from a preheated idle printer, hot and without a reset, to the same end",
          "[optimised]") {
  const auto last_bead = [](const std::string& lines) {
    std::string last;
    std::istringstream all(lines);
    for (std::string line; std::getline(all, line);)
      if (line.find("G1 ") != std::string::npos && line.find(" E") != std::string::npos &&
          line.find(" X") != std::string::npos)
        last = line.substr(line.find("G1 "));
    return last.substr(0, last.find(" E"));
  };
  DaemonBench reference;
  reference.start_printer("0");
  reference.serve();
  REQUIRE(reference.command({"queue", "--add", "plate.toml", "--layers", "0:3"}).code == 0);
  REQUIRE(reference.command({"start"}).code == 0);
  reference.await_job(1, "done");
  IdleDaemon bench;
  REQUIRE(bench.command({"queue", "--add", "plate.toml", "--layers", "0:3"}).code == 0);
  REQUIRE(bench.command({"start"}).code == 0);
  test::await([&] { return bench.ask("GET", "/api/status").value("/print/layer"_json_pointer, 0) > 1; },
              bench.daemon());
  REQUIRE(bench.command({"cancel"}).code == 0);
  bench.await_job(1, "stopped");
  bench.connect();
  REQUIRE(bench.post("heat", R"({"nozzle_c": 200, "bed_c": 60})") == 202);
  bench.until([](const json& now) { return now["bed"].value("target_c", 0.0) == 60; });
  const std::size_t before = test::read_text(bench.path("lines.txt")).size();
  const json kept = bench.ask("GET", "/api/prints")["prints"];
  REQUIRE(kept.size() == 1);
  const json body{{"name", kept[0]["name"]}, {"sure", true}};
  const json going = bench.ask("POST", "/api/prints/resume", body.dump());
  INFO(going.dump());
  REQUIRE(going.contains("id"));
  bench.await_job(going["id"], "done");
  bench.until([](const json& now) { return now["connection"] == "open"; });
  const std::string lines = bench.transcript();
  const std::string rest = lines.substr(before);
  for (const char* off : {"M104 S0", "M140 S0"}) {  // hot until the end
    REQUIRE(rest.find(off) != std::string::npos);
    CHECK(rest.find(off) > rest.rfind(" E"));
  }
  CHECK(occurrences(lines, "M115") == 4);  // print, connection, rest of the print, connection
  CHECK_FALSE(last_bead(rest).empty());
  CHECK(last_bead(rest) == last_bead(reference.transcript()));
}

TEST_CASE("a firmware's name is bounded and shown without control characters, whatever it holds") {
  const std::string name = "<img src=x onerror=alert(1)>\x1b[2J\x07\xff" + std::string(10'000, 'n');
  IdleDaemon bench("50", {"--fault", "say:FIRMWARE_NAME:" + name + "@command=M115"});
  bench.connect();
  const std::string shown = bench.printer()["firmware"];
  CHECK(shown.find("<img src=x onerror=alert(1)>") != std::string::npos);  // the page shows it as text
  CHECK(shown.size() < 1000);
  const auto controls = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  CHECK(std::none_of(shown.begin(), shown.end(), controls));
  const std::string log = bench.ask("GET", "/api/log")["lines"].dump();
  CHECK(log.find("\\u001b") == std::string::npos);
}

TEST_CASE("a daemon that ends switches an idle printer off") {
  IdleDaemon bench;
  bench.connect();
  REQUIRE(bench.post("heat", R"({"nozzle_c": 200, "bed_c": 60})") == 202);
  bench.until([](const json& now) { return now["nozzle"].value("target_c", 0.0) == 200; });
  kill(bench.daemon().id(), SIGTERM);
  CHECK(bench.daemon().wait().code == 0);
  const std::string lines = bench.transcript();
  CHECK(lines.rfind("M104 S0") > lines.rfind("M104 S200"));
  CHECK(lines.rfind("M140 S0") > lines.rfind("M140 S60"));
}

TEST_CASE("filament that moves is stopped at once, and the daemon goes on") {
  IdleDaemon bench("200", {}, {"--on-event", "cat > /dev/null"});
  bench.connect();
  REQUIRE(bench.post("feed", R"({"action": "load", "feeder": 1, "length": 2000})") == 202);
  bench.until([](const json& now) {
    return now.value("action", "") == "feeding" && now["nozzle"].value("actual_c", 0.0) > 100;
  });
  CHECK(bench.status(bench.request("POST", "/api/print/stop", "{}")) == 202);
  bench.until([](const json& now) { return now["connection"] == "closed"; });
  CHECK(bench.ask("GET", "/api/status")["state"] == "idle");
  CHECK(bench.printer()["problem"].get<std::string>().find("stopped at once") != std::string::npos);
}

TEST_CASE("the profile is shown and changed, and its comments stay") {
  IdleDaemon bench;
  const std::string file = bench.path("jobs/bench.toml.profile");
  const auto put = [&](const json& body) {
    return bench.send(bench.request("PUT", "/api/profile", body.dump()));
  };
  json shown = bench.ask("GET", "/api/profile");
  CHECK(shown["toml"] == test::read_text(file));
  bool found = false;
  for (const json& key : shown["keys"]) {
    CHECK_FALSE(key["help"].get<std::string>().empty());
    if (key["key"] != "printer.nozzle") continue;
    found = true;
    CHECK(key["unit"] == "mm");
    CHECK(key["value"].is_number());
  }
  CHECK(found);
  const std::string noted = test::read_text(file) + "\n[transition]  # measured\ndead_volume = 3.0  # mm3\n";
  CHECK(test::status_of(put({{"toml", noted}})) == 200);
  CHECK(test::status_of(put({{"values", {{"transition.dead_volume", 2.5}}}})) == 200);
  CHECK(test::read_text(file).find("[transition]  # measured\ndead_volume = 2.5  # mm3") !=
        std::string::npos);
  const std::string wrong = put({{"toml", "[printer]\nnozzle = 99\n"}});
  CHECK(test::status_of(wrong) == 422);
  CHECK(wrong.find("\"line\":2") != std::string::npos);
  CHECK(wrong.find("\"key\":\"printer.nozzle\"") != std::string::npos);
  CHECK(test::status_of(put({{"values", {{"printer.nose", 1}}}})) == 422);
  CHECK(test::status_of(put(json::object())) == 400);
  CHECK(test::read_text(file).find("dead_volume = 2.5") != std::string::npos);  // untouched
}

TEST_CASE("a printer is examined, also while it is connected", "[optimised]") {
  IdleDaemon bench;
  for (const bool connected : {false, true}) {
    if (connected) bench.connect();
    const json found = bench.ask("POST", "/api/doctor", "{}");
    INFO(found.dump());
    REQUIRE(found["findings"].size() > 3);
    CHECK(found["firmware"].get<std::string>().find("Marlin") == 0);
    for (const json& one : found["findings"]) CHECK(one["grade"] != "bad");
  }
  bench.until([](const json& now) { return now["connection"] == "open"; });
  CHECK(bench.ask("GET", "/api/frames")["frames"].size() == 8);
  CHECK(bench.ask("GET", "/api/ports")["ports"].is_array());
}

TEST_CASE("OctoPrint's clients connect, heat, home and move an idle printer") {
  IdleDaemon bench;
  const auto octo = [&](const std::string& target, const std::string& body) {
    return bench.status(bench.request("POST", target, body));
  };
  CHECK(octo("/api/connection", R"({"command": "connect"})") == 204);
  bench.until([](const json& now) { return now["connection"] == "open"; });
  CHECK(octo("/api/printer/tool", R"({"command": "target", "targets": {"tool0": 190}})") == 204);
  CHECK(octo("/api/printer/bed", R"({"command": "target", "target": 50})") == 204);
  CHECK(octo("/api/printer/printhead", R"({"command": "jog", "x": 5})") == 409);
  CHECK(octo("/api/printer/printhead", R"({"command": "home", "axes": ["x", "y", "z"]})") == 204);
  bench.until([](const json& now) { return now["homed"] == true && now.contains("at"); });
  CHECK(octo("/api/printer/printhead", R"({"command": "jog", "x": 5, "z": 3})") == 204);
  CHECK(octo("/api/printer/printhead", R"({"command": "jog", "x": 12, "absolute": true})") == 204);
  bench.until([](const json& now) { return now.contains("at") && now["at"][0] == 12; });
  CHECK(bench.printer()["at"][2] == 3);
  bench.until([](const json& now) { return now["temperature"]["tool0"]["actual"] > 185; });
  CHECK(octo("/api/printer/tool", R"({"command": "extrude", "amount": 6})") == 204);
  CHECK(octo("/api/connection", R"({"command": "disconnect"})") == 204);
}

TEST_CASE("load, purge and unload go through the daemon that has the printer, and leave it as it was",
          "[optimised]") {
  IdleDaemon bench("1000");
  const auto by_command = [&](std::vector<std::string> words) { return bench.command(std::move(words)); };
  const std::string profile = bench.path("jobs/bench.toml.profile");
  const test::Outcome loaded =
      by_command({"load", profile, "--port", bench.path("port"), "--feeder", "2", "--length", "5", "--yes"});
  INFO(loaded.err);
  CHECK(loaded.code == 0);
  CHECK(loaded.out.find("the daemon moves the filament\n") == 0);
  CHECK(loaded.out.find("feeder 2 has fed 5 mm; the nozzle cools\n") != std::string::npos);
  bench.until([](const json& now) { return now["connection"] == "closed"; });
  // One that a client has connected stays connected; a remote daemon needs no profile here.
  bench.connect();
  const test::Outcome pulled = test::run({"unload", "--feeder", "1", "--length", "6", "--yes", "--daemon",
                                          "http://" + bench.host(), "--token", bench.token()});
  CHECK(pulled.out.find("feeder 1 has pulled 6 mm back; the nozzle cools\n") != std::string::npos);
  CHECK(bench.printer()["connection"] == "open");
  CHECK(bench.printer()["fed"] == "completed");
  const test::Outcome too_far = by_command({"purge", "--feeder", "4", "--yes"});
  CHECK(too_far.code == 2);
  CHECK(too_far.err.find("feeder 4") != std::string::npos);
  // Ctrl-C ends it.
  test::Child purge({"purge", "--length", "2000", "--yes", "--state", bench.path("state")});
  bench.until([](const json& now) { return now.value("action", "") == "feeding"; });
  kill(purge.id(), SIGINT);
  const test::Outcome ended = purge.wait();
  CHECK(ended.code == 3);
  CHECK(ended.out.find("stopped; the nozzle cools\n") != std::string::npos);
  CHECK(ended.err.find("each feeder purges 2000 mm") != std::string::npos);
  bench.until([](const json& now) { return now["nozzle"].value("target_c", 1.0) == 0; });
  // A print has the printer for itself.
  REQUIRE(bench.command({"queue", "--add", "plate.toml"}).code == 0);
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_print("printing");
  const test::Outcome refused = by_command({"purge", "--yes"});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("a print is going on") != std::string::npos);
  CHECK(bench.print_state() == "printing");
}

TEST_CASE("feeding that fails closes the connection that the command had opened", "[optimised]") {
  IdleDaemon bench("1000", {"--fault", "reset@line=24"});
  const test::Outcome outcome = bench.command({"purge", "--length", "2000", "--yes"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("see `unicursal status`") != std::string::npos);
  bench.until([](const json& now) { return now["connection"] == "closed"; });
}

TEST_CASE("who feeds by a daemon that is killed reads that the nozzle may be hot, and no refusal") {
  IdleDaemon bench("10");
  test::Child purge({"purge", "--length", "2000", "--yes", "--state", bench.path("state")});
  bench.until([](const json& now) { return now.value("action", "") == "feeding"; });
  kill(bench.daemon().id(), SIGKILL);
  const test::Outcome outcome = purge.wait();
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("the nozzle may still be hot: look at `unicursal status`\n") != std::string::npos);
}

TEST_CASE("a second Ctrl-C ends a command whose daemon cannot stop yet", "[optimised]") {
  IdleDaemon bench("4");
  test::Child purge({"purge", "--length", "2000", "--yes", "--state", bench.path("state")});
  bench.until([](const json& now) { return now.value("doing", "").find("heats") != std::string::npos; });
  kill(purge.id(), SIGINT);
  bench.until([](const json& now) { return now.value("doing", "") == "each feeder purges 2000 mm"; });
  kill(purge.id(), SIGINT);
  const test::Outcome outcome = purge.wait();
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("the printer may still be feeding") != std::string::npos);
}
