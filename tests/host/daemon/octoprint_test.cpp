// Slicers and other clients of OctoPrint's API against the real daemon. curl sends what they send: the
// fields, their order and names as in src/slic3r/Utils/OctoPrint.cpp of PrusaSlicer, SuperSlicer and
// OrcaSlicer, and in OctoPrintOutputDevice.py of Cura's plugin.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/slicer_bench.hpp"

using namespace unicursal;
using nlohmann::json;
using test::CurlAnswer;
using test::DaemonBench;
using test::Outcome;
using test::RawConnection;
using test::SlicerBench;

namespace {

namespace fs = std::filesystem;

bool has_curl() {
  return std::system("curl --version > /dev/null 2>&1") == 0;
}

}  // namespace

TEST_CASE("slicers upload as to an OctoPrint, and the file waits in the queue") {
  REQUIRE(has_curl());
  SlicerBench bench;
  const json version = bench.get("/api/version").body();
  CHECK(version.contains("api"));
  CHECK(version["text"].get<std::string>().starts_with("OctoPrint"));

  SECTION("PrusaSlicer, SuperSlicer and OrcaSlicer: upload and print") {
    const CurlAnswer sent = bench.slic3r(bench.path("plate 1.svg"), "plate 1.svg");
    INFO(sent.text);
    REQUIRE(sent.status == 201);
    const json body = sent.body();
    CHECK(body["done"] == true);
    CHECK(body["effectivePrint"] == false);
    CHECK(body["files"]["local"]["name"] == "plate_1.svg");
    CHECK(body["files"]["local"]["origin"] == "local");
    CHECK(body["files"]["local"]["refs"]["resource"] ==
          "http://" + bench.host() + "/api/files/local/plate_1.svg");
    const json jobs = bench.ask("GET", "/api/jobs")["jobs"];
    REQUIRE(jobs.size() == 1);
    CHECK(jobs[0]["job"] == "upload:plate_1/plate_1.svg");
    CHECK(jobs[0]["state"] == "queued");
    CHECK(test::read_text(bench.path("state/files/plate_1/plate_1.svg")) == test::sample_drawing);
  }
  SECTION("the same without printing: the file is kept, and not queued") {
    CHECK(bench.slic3r(bench.path("plate 1.svg"), "plate 1.svg", "false").status == 201);
    CHECK(bench.waiting() == 0);
    CHECK(bench.kept() == std::vector<std::string>{"plate_1", "plate_1/plate_1.svg"});
    const json files = bench.get("/api/files/local").body()["files"];
    const auto names = files.dump();
    CHECK(names.find("\"path\":\"plate_1.svg\"") != std::string::npos);
    CHECK(names.find("\"path\":\"plate.toml\"") != std::string::npos);
    // OctoPrint's way to print it later.
    CHECK(bench.post("/api/files/local/plate_1.svg", R"({"command": "select", "print": true})", bench.key)
              .status == 204);
    CHECK(bench.waiting() == 1);
  }
  SECTION("Cura's plugin: the folder first, and what to do behind the file") {
    const CurlAnswer sent =
        bench.curl("-H 'X-Api-Key: " + bench.key +
                       "' -A 'Cura/5.7 OctoPrintPlugin/3.7' -F 'path=toys;type=text/plain' "
                       "-F 'file=@\"" +
                       bench.path("plate 1.svg") +
                       "\";filename=\"CE3_plate.svg\";type=application/octet-stream' "
                       "-F 'select=true;type=text/plain' -F 'print=true;type=text/plain'",
                   "/api/files/local");
    INFO(sent.text);
    CHECK(sent.status == 201);
    CHECK(sent.body()["effectiveSelect"] == true);
    CHECK(bench.waiting() == 1);
  }
  SECTION("a bearer of the key, and the token") {
    for (const std::string& secret : {bench.key, bench.token()})
      CHECK(bench
                .curl("-H 'Authorization: Bearer " + secret + "' -F print=true -F 'file=@\"" +
                          bench.path("plate 1.svg") + "\"'",
                      "/api/files/local")
                .status == 201);
    // The first one waits, so it is not replaced.
    CHECK(bench.kept().size() == 4);
    CHECK(bench.ask("GET", "/api/jobs")["jobs"][1]["job"] == "upload:plate_1-2/plate_1-2.svg");
  }
  SECTION("a file of the same name replaces one that does not wait") {
    CHECK(bench.slic3r(bench.path("plate 1.svg"), "a.svg", "false").status == 201);
    bench.folder().write("other.svg", test::replaced(test::sample_drawing, "<svg", "<!-- new --><svg"));
    CHECK(bench.slic3r(bench.path("other.svg"), "a.svg", "false").status == 201);
    CHECK(bench.kept() == std::vector<std::string>{"a", "a/a.svg"});
    CHECK(test::read_text(bench.path("state/files/a/a.svg")).find("new") != std::string::npos);
    CHECK(bench.curl("-X DELETE -H 'X-Api-Key: " + bench.key + "'", "/api/files/local/a.svg").status == 204);
    CHECK(bench.kept().empty());
    CHECK(bench.curl("-X DELETE -H 'X-Api-Key: " + bench.key + "'", "/api/files/local/a.svg").status == 404);
    CHECK(bench.curl("-X DELETE -H 'X-Api-Key: " + bench.key + "'", "/api/files/local/plate.toml").status ==
          403);
  }
  SECTION("models and jobs of all sorts") {
    bench.folder().write("job.toml", "[part]\nfiles = [\"a.svg\"]\n");
    const CurlAnswer sent = bench.slic3r(bench.path("job.toml"), "job.toml");
    CHECK(sent.status == 422);  // its drawing is missing
    CHECK(bench.kept().empty());
  }
}

TEST_CASE("G-code of a slicer waits in the queue, and is refused if it would break the print") {
  SlicerBench bench;
  gcode::test::BlockOptions options;
  options.layers = 3;
  const std::string text = gcode::test::sliced_block(options).text;
  bench.folder().write("block.gcode", text);
  bench.folder().write("bad.gcode", test::replaced(text, "G92 E0\n", "G92 E0\nM112\n"));
  const CurlAnswer sent = bench.slic3r(bench.path("block.gcode"), "block.gcode");
  INFO(sent.text);
  CHECK(sent.status == 201);
  CHECK(sent.body()["files"]["local"]["type"] == "machinecode");
  CHECK(bench.ask("GET", "/api/jobs/1")["job"] == "upload:block/block.gcode");
  const CurlAnswer bad = bench.slic3r(bench.path("bad.gcode"), "bad.gcode");
  CHECK(bad.status == 422);
  CHECK(bad.text.find("M112") != std::string::npos);
  // What is not read is refused also when it is large: the slicer gets the sentence, and not a broken
  // connection.
  bench.folder().write("large.bgcode", std::string(30'000'000, '\n'));
  const CurlAnswer large = bench.slic3r(bench.path("large.bgcode"), "large.bgcode");
  CHECK(large.status == 415);
  CHECK(large.text.find("binary G-code is not read here") != std::string::npos);
  CHECK(bench.kept() == std::vector<std::string>{"block", "block/block.gcode"});
}

TEST_CASE("uploads that must be refused are refused, and leave nothing behind") {
  SlicerBench bench;
  const std::string file = bench.path("plate 1.svg");
  const std::string end = "--b0--\r\n";

  SECTION("with a wrong key, or none, before the file is read") {
    CHECK(bench
              .curl("-H 'X-Api-Key: " + std::string(64, '0') + "' -F 'file=@\"" + file + "\"'",
                    "/api/files/local")
              .status == 403);
    CHECK(bench.curl("-F 'file=@\"" + file + "\"'", "/api/files/local").status == 401);
    const std::string watching = bench.key_named("phone", "watch");
    const CurlAnswer refused =
        bench.curl("-H 'X-Api-Key: " + watching + "' -F 'file=@\"" + file + "\"'", "/api/files/local");
    CHECK(refused.status == 403);
    CHECK(refused.text.find("has the right to watch only") != std::string::npos);
  }
  SECTION("too large for the daemon or for its disk") {
    RawConnection huge(bench.port());
    huge.send(test::replaced(bench.form("x"), "Content-Length: 1", "Content-Length: 99999999999"));
    CHECK(test::status_of(huge.read_until("\r\n\r\n")) == 413);
    const rlimit full{100'000, RLIM_INFINITY};
    REQUIRE(prlimit(bench.daemon().id(), RLIMIT_FSIZE, &full, nullptr) == 0);
    bench.folder().write("large.svg", std::string(3'000'000, ' '));
    const CurlAnswer sent = bench.slic3r(bench.path("large.svg"), "large.svg");
    CHECK(sent.status == 507);
    CHECK(sent.text.find("make room on the daemon's disk") != std::string::npos);
  }
  SECTION("cut in the middle, at any place") {
    const std::string whole = bench.form(SlicerBench::file_part("a.svg", std::string(400'000, ' ')) + end);
    for (const std::size_t cut : {whole.size() - 1, whole.size() - 20, whole.size() / 2, std::size_t{300}}) {
      RawConnection connection(bench.port());
      connection.send(whole.substr(0, cut));
      connection.finish_sending();
      CHECK(test::status_of(connection.read_all()) == 400);
      RawConnection gone(bench.port());
      gone.send(whole.substr(0, cut));  // and leaves without a word
    }
    CHECK(bench.status(bench.form(SlicerBench::file_part("a.svg", "x") + "--b0")) == 400);  // no end
  }
  SECTION("with names that lead elsewhere") {
    for (const char* name : {"../../../evil.svg", "/evil.svg", "..\\\\evil.svg", "C:\\\\temp\\\\evil.svg"})
      CHECK(bench.status(bench.form(SlicerBench::file_part(name, test::sample_drawing) + end)) == 201);
    CHECK(bench.kept() == std::vector<std::string>{"evil", "evil/evil.svg"});
    CHECK_FALSE(fs::exists("/evil.svg"));
    CHECK_FALSE(fs::exists(bench.path("evil.svg")));
    bench.curl("-X DELETE -H 'X-Api-Key: " + bench.key + "'", "/api/files/local/evil.svg");
    for (const std::string& name :
         {std::string(".."), std::string(".svg"), std::string("x."), std::string("svg"), std::string("a.exe"),
          std::string("a.svg.part"), std::string(300, 'a') + ".svg", std::string("a.svg/")}) {
      CAPTURE(name);
      const int status = bench.status(bench.form(SlicerBench::file_part(name, "x") + end));
      CHECK((status == 400 || status == 415 || (name == ".svg" && status == 201)));
    }
    CHECK(bench.status(bench.form(SlicerBench::file_part("a\x01.svg", "x") + end)) == 400);
    CHECK(bench.status(bench.form(
              test::replaced(SlicerBench::file_part("", "x"), "filename=\"\"", "filename*=UTF-8''a%00.svg") +
              end)) == 400);
    bench.curl("-X DELETE -H 'X-Api-Key: " + bench.key + "'", "/api/files/local/unnamed.svg");
  }
  SECTION("without a file, with two, with an empty one, or not a form") {
    const std::string field = "--b0\r\nContent-Disposition: form-data; name=\"print\"\r\n\r\ntrue\r\n";
    CHECK(bench.status(bench.form(field + end)) == 400);
    CHECK(bench.status(bench.form(SlicerBench::file_part("a.svg", "x") +
                                  SlicerBench::file_part("b.svg", "x") + end)) == 400);
    CHECK(bench.status(bench.form(SlicerBench::file_part("a.svg", "") + end)) == 400);
    CHECK(bench.status(bench.form(test::replaced(field, "true", std::string(5000, 'a')) + end)) == 413);
    CHECK(bench.post("/api/files/local", "{}", bench.key).status == 415);
  }
  SECTION("by the fifth client at once") {
    std::vector<std::unique_ptr<RawConnection>> slow;
    const std::string whole = bench.form(SlicerBench::file_part("a.svg", std::string(400'000, ' ')) + end);
    for (int i = 0; i < 4; ++i) {
      slow.push_back(std::make_unique<RawConnection>(bench.port()));
      slow.back()->send(whole.substr(0, 330'000));
    }
    test::await([&] { return bench.kept().size() == 4; }, bench.daemon());  // four drafts
    CHECK(bench.slic3r(file, "plate.svg").status == 503);
    slow.clear();
    test::await([&] { return bench.kept().empty(); }, bench.daemon());
    CHECK(bench.slic3r(file, "plate.svg", "false").status == 201);
    bench.curl("-X DELETE -H 'X-Api-Key: " + bench.key + "'", "/api/files/local/plate.svg");
  }
  test::await([&] { return bench.kept().empty(); }, bench.daemon());
  CHECK(bench.waiting() == 0);
  CHECK(bench.get("/api/version").status == 200);
}

TEST_CASE("an upload that comes too slowly is refused", "[long]") {
  SlicerBench bench;
  RawConnection slow(bench.port());
  const std::string whole =
      bench.form(SlicerBench::file_part("a.svg", std::string(10'000, ' ')) + "--b0--\r\n");
  slow.send(whole.substr(0, 1000));
  CHECK(test::status_of(slow.read_all()) == 408);
  CHECK(bench.kept().empty());
}

TEST_CASE("drafts that a dead daemon has left are removed") {
  DaemonBench bench;
  fs::create_directories(bench.path("state/files"));
  fs::permissions(bench.path("state"), fs::perms::owner_all);
  bench.folder().write("state/files/.draft-abcdef", "half a file");
  bench.serve();
  CHECK_FALSE(fs::exists(bench.path("state/files/.draft-abcdef")));
}

TEST_CASE("keys have rights, and can be asked for, granted, denied and removed") {
  SlicerBench bench;
  CHECK(bench.post("/api/print/start", "{}", bench.key).status == 403);
  CHECK(bench.post("/api/job", R"({"command": "start"})", bench.key).status == 403);
  const std::string phone = bench.key_named("phone", "steer");
  CHECK(bench.post("/api/print/pause", "{}", phone).status == 409);
  // Keys are managed by the owner only, and do not cross the network.
  CHECK(bench.post("/api/keys", R"({"name": "x"})", phone).status == 403);
  const json known = bench.ask("GET", "/api/keys");
  CHECK(known["keys"][0]["name"] == "slicer");
  CHECK(known.dump().find(bench.key) == std::string::npos);
  CHECK(bench.curl("-H 'X-Api-Key: " + phone + "'", "/api/keys").status == 403);

  CHECK(bench.curl("", "/plugin/appkeys/probe").status == 204);
  CHECK(bench.curl("-H 'Origin: http://evil.example'", "/plugin/appkeys/probe").status == 403);
  const auto asks = [&] {
    const CurlAnswer asked =
        bench.curl("-H 'Content-Type: application/json' -d '{\"app\": \"Home \\u001b[31mAssistant\"}'",
                   "/plugin/appkeys/request");
    REQUIRE(asked.status == 201);
    return "/plugin/appkeys/request/" + asked.body()["app_token"].get<std::string>();
  };
  const std::string first = asks(), second = asks();
  CHECK(bench.curl("", first).status == 202);
  const Outcome listed = bench.command({"keys"});
  CHECK(listed.out.find(
            "\"Home \\x1b[31mAssistant\" at 127.0.0.1 asks for a key: `unicursal keys --grant 1`") !=
        std::string::npos);
  CHECK(listed.out.find("1 slicer: queue, " + bench.key) != std::string::npos);
  CHECK(bench.command({"keys", "--grant", "1"}).code == 0);
  CHECK(bench.command({"keys", "--deny", "2"}).code == 0);
  CHECK(bench.command({"keys", "--grant", "2"}).code != 0);
  const CurlAnswer granted = bench.curl("", first);
  REQUIRE(granted.status == 200);
  const std::string key = granted.body()["api_key"];
  CHECK(bench.curl("", first).status == 404);  // once
  CHECK(bench.curl("", second).status == 404);
  CHECK(bench.curl("-H 'X-Api-Key: " + key + "'", "/api/status").status == 200);
  const json user = bench.curl("-H 'X-Api-Key: " + key + "'", "/api/currentuser").body();
  CHECK(user["name"] == "Home \\x1b[31mAssistant");
  CHECK(bench.post("/api/login", R"({"passive": true})", key).body()["name"] == user["name"]);

  CHECK(bench.command({"keys", "--remove", "3"}).code == 0);
  CHECK(bench.curl("-H 'X-Api-Key: " + key + "'", "/api/status").status == 403);
  CHECK(bench.curl("-H 'X-Api-Key: " + phone + "'", "/api/status").status == 200);
  CHECK((fs::status(bench.path("state/keys.json")).permissions() & fs::perms::all) ==
        (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("strangers who ask for keys are few, and take no place of others") {
  SlicerBench bench;
  const std::string ask = "-H 'Content-Type: application/json' -d '{\"app\": \"x\"}'";
  for (int i = 0; i < 8; ++i) CHECK(bench.curl(ask, "/plugin/appkeys/request").status == 201);
  CHECK(bench.curl(ask, "/plugin/appkeys/request").status == 503);
  CHECK(bench.curl("-H 'Content-Type: application/json' -d '{}'", "/plugin/appkeys/request").status == 400);
  CHECK(bench.curl("-X DELETE", "/plugin/appkeys/probe").status == 405);
  std::vector<std::unique_ptr<RawConnection>> strangers;
  for (int i = 0; i < 80; ++i) {
    strangers.push_back(std::make_unique<RawConnection>(bench.port()));
    strangers.back()->send("POST /plugin/appkeys/request HTTP/1.1\r\nHost: " + bench.host() +
                           "\r\nContent-Length: 1000\r\n\r\n");
  }
  CHECK(bench.get("/api/version").status == 200);
}

TEST_CASE("OctoPrint's clients see the printer and steer its print") {
  SlicerBench bench;
  const std::string phone = bench.key_named("phone", "steer");
  // Its port is not there: it is switched off.
  CHECK(bench.get("/api/printer").status == 409);
  CHECK(bench.get("/api/connection").body()["current"]["state"] == "Closed");
  CHECK(bench.get("/api/job").body()["state"] == "Offline");
  CHECK(bench.post("/api/connection", R"({"command": "connect"})", phone).status == 412);
  CHECK(bench.ask("GET", "/api/printer")["state"]["flags"]["closedOrError"] ==
        true);  // our own API says so with 200
  bench.start_printer("100");
  CHECK(bench.post("/api/connection", R"({"command": "connect"})", phone).status == 204);
  const json idle = bench.get("/api/printer").body();
  CHECK(idle["state"]["text"] == "Operational");
  CHECK(idle["state"]["flags"]["ready"] == true);
  CHECK(idle["temperature"].empty());  // not 0 °C: nobody knows
  CHECK(bench.get("/api/job").body()["job"]["file"]["name"].is_null());
  CHECK(bench.get("/api/server").body()["safemode"] == false);
  CHECK(bench.get("/api/settings").body()["webcam"]["webcamEnabled"] == false);
  const json profile = bench.get("/api/printerprofiles").body()["profiles"]["_default"];
  CHECK(profile["volume"]["width"] == 120);
  CHECK(profile["extruder"]["count"] == 1);

  bench.folder().write("own.svg", test::sample_drawing);
  REQUIRE(bench.slic3r(bench.path("own.svg"), "own.svg").status == 201);
  CHECK(bench.get("/api/job").body()["job"]["file"]["name"] == "own.svg");
  REQUIRE(bench.post("/api/job", R"({"command": "start"})", phone).status == 204);
  CHECK(bench.post("/api/job", R"({"command": "start"})", phone).status == 409);
  bench.await_laying();
  const json printing = bench.get("/api/printer").body();
  CHECK(printing["state"]["text"] == "Printing");
  CHECK(printing["state"]["flags"]["printing"] == true);
  CHECK(printing["temperature"]["tool0"]["target"].get<double>() > 100);
  CHECK(bench.get("/api/job").body()["progress"]["printTime"].is_number_integer());
  CHECK(bench.curl("-X DELETE -H 'X-Api-Key: " + bench.key + "'", "/api/files/local/own.svg").status == 409);
  CHECK(bench.post("/api/job", R"({"command": "pause", "action": "resume"})", phone).status ==
        204);  // it goes on
  CHECK(bench.post("/api/job", R"({"command": "pause", "action": "pause"})", phone).status == 204);
  bench.await_print("paused");
  CHECK(bench.get("/api/printer").body()["state"]["flags"]["paused"] == true);
  CHECK(bench.post("/api/job", R"({"command": "pause"})", phone).status == 204);  // toggles
  bench.await_print("printing");
  CHECK(bench.post("/api/job", R"({"command": "brew"})", phone).status == 400);
  CHECK(bench.post("/api/job", R"({"command": "cancel"})", phone).status == 204);
  bench.await_job(1, "stopped");
}

TEST_CASE("an upload starts by itself only if the user wants that and has confirmed that the bed is clear") {
  const bool wanted = GENERATE(false, true);
  CAPTURE(wanted);
  SlicerBench bench(wanted ? std::vector<std::string>{"--start-uploads"} : std::vector<std::string>{});
  bench.start_printer("100");
  bench.folder().write("own.svg", test::sample_drawing);
  const auto send = [&](const std::string& print) {
    const CurlAnswer sent = bench.slic3r(bench.path("own.svg"), "own.svg", print);
    REQUIRE(sent.status == 201);
    return sent.body()["effectivePrint"].get<bool>();
  };
  CHECK_FALSE(send("true"));  // nobody has looked at the bed
  CHECK(bench.ask("GET", "/api/jobs/1")["state"] == "queued");
  REQUIRE(bench.command({"queue", "--bed-clear"}).code == 0);
  if (!wanted) {
    CHECK(bench.ask("GET", "/api/status")["state"] == "idle");
    CHECK_FALSE(send("true"));
    CHECK(bench.waiting() == 2);
    return;
  }
  bench.await_print("printing");
  REQUIRE(bench.command({"cancel"}).code == 0);
  bench.await_job(1, "stopped");
  CHECK_FALSE(send("true"));  // its part lies there
  CHECK(bench.ask("GET", "/api/status")["bed_clear"] == false);
  bench.command({"queue", "--remove", "2"});
  REQUIRE(bench.command({"queue", "--bed-clear"}).code == 0);
  bench.command({"queue", "--add", "plate.toml", "--layers", "0:0"});  // not sent to be printed
  CHECK(bench.ask("GET", "/api/status")["state"] == "idle");
  CHECK_FALSE(send("false"));
  CHECK(bench.ask("GET", "/api/status")["state"] == "idle");
  CHECK(send("true"));
  CHECK(bench.ask("GET", "/api/jobs/4")["state"] != "queued");
}
