// The user's command that hears of prints.
#include "host/daemon/event_command.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;

namespace {

std::string at(const test::TempFolder& folder, const std::string& name) {
  return (folder / name).string();
}

/// The events that the command has written, one JSON object a line.
std::vector<json> events_in(const std::string& file) {
  std::vector<json> events;
  std::istringstream lines(test::read_text(file));
  for (std::string line; std::getline(lines, line);) {
    const json event = json::parse(line, nullptr, false);
    if (event.is_object()) events.push_back(event);
  }
  return events;
}

std::size_t times(const std::vector<json>& events, const std::string& kind) {
  std::size_t found = 0;
  for (const json& event : events) found += event["event"] == kind;
  return found;
}

void await_file(const std::string& file, std::size_t size) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  std::error_code error;
  while (!std::filesystem::exists(file, error) || std::filesystem::file_size(file, error) < size) {
    REQUIRE(std::chrono::steady_clock::now() < end);
    poll(nullptr, 0, 5);
  }
}

}  // namespace

TEST_CASE("a command that hangs is killed with all its children, and the next event is heard") {
  const test::TempFolder folder;
  const std::string log = at(folder, "log");
  host::EventCommand command("if [ \"$UNICURSAL_EVENT\" = first ]; then sleep 1000 & echo $! >> " + log +
                                 "; wait; fi; cat >> " + log,
                             std::chrono::milliseconds(300));
  command.run({"first", "", "{}"});
  command.run({"second", "", "{\"event\":\"second\"}"});
  await_file(log, 1);
  const pid_t sleeper = std::stoi(test::read_text(log));
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (times(events_in(log), "second") == 0) {
    REQUIRE(std::chrono::steady_clock::now() < end);
    poll(nullptr, 0, 5);
  }
  const std::string state = test::read_text("/proc/" + std::to_string(sleeper) + "/stat");
  CHECK((state.empty() || state.find(") Z") != std::string::npos));
}

TEST_CASE("a command gets no secrets of the daemon's environment, and hostile texts as they are") {
  const test::TempFolder folder;
  setenv("UNICURSAL_TOKEN", "very secret", 1);
  const std::string text = "$(touch " + at(folder, "harm") + "); `id` @file";
  {
    host::EventCommand command("env > " + at(folder, "env") + "; printf '%s' \"$UNICURSAL_TEXT\" > " +
                               at(folder, "text"));
    command.run({"print_ended", text, "{}"});
    await_file(at(folder, "text"), text.size());
  }
  unsetenv("UNICURSAL_TOKEN");
  CHECK(test::read_text(at(folder, "text")) == text);
  CHECK(test::read_text(at(folder, "env")).find("PATH=") != std::string::npos);
  CHECK(test::read_text(at(folder, "env")).find("secret") == std::string::npos);
  CHECK_FALSE(std::filesystem::exists(at(folder, "harm")));
}

TEST_CASE("the examples pass a hostile sentence on as text") {
  const test::TempFolder folder;
  std::filesystem::create_directory(at(folder, "bin"));
  for (const char* program : {"bin/curl", "bin/sendmail"}) {
    folder.write(program, "#!/bin/sh\nprintf '%s\\n' \"$@\" > " + at(folder, "words") + "; cat > " +
                              at(folder, "input") + "\n");
    std::filesystem::permissions(at(folder, program), std::filesystem::perms::owner_all);
  }
  folder.write("event.json", "{\"event\":\"problem\"}\n");
  const auto run_example = [&](const std::string& example) {
    const std::string words =
        "PATH=" + at(folder, "bin") + ":$PATH UNICURSAL_EVENT=problem UNICURSAL_TEXT='@/etc/passwd $(id)' " +
        (test::source_folder() / "host/examples" / example).string() + " < " + at(folder, "event.json");
    return std::system(words.c_str());
  };
  REQUIRE(run_example("notify-ntfy https://ntfy.example/topic") == 0);
  const std::string sent = test::read_text(at(folder, "words"));
  CHECK(sent.find("--data-raw\n@/etc/passwd $(id)\n") != std::string::npos);
  CHECK(sent.find("--\nhttps://ntfy.example/topic\n") != std::string::npos);
  REQUIRE(run_example("notify-mail me@example.org") == 0);
  CHECK(test::read_text(at(folder, "words")) == "-i\n--\nme@example.org\n");
  const std::string mail = test::read_text(at(folder, "input"));
  CHECK(mail.find("Subject: unicursal: problem\n") != std::string::npos);
  CHECK(mail.find("\n\n@/etc/passwd $(id)\n\n{\"event\":\"problem\"}\n") != std::string::npos);
  CHECK(run_example("notify-mail") != 0);
}

TEST_CASE("each kind of event of a print is heard once", "[optimised]") {
  DaemonBench bench;
  const std::string log = bench.path("events");
  bench.start_printer("100", {"--personality", "marlin-host", "--fault", "filamentchange@line=300", "--fault",
                              "disconnect:1@line=500"});
  bench.serve({"--on-event", "cat >> " + log});
  bench.ask("POST", "/api/jobs", R"({"job": "plate.toml", "layers": [0, 4]})");
  bench.ask("POST", "/api/print/start", "{}");
  const auto asks = [&](const std::string& text) {
    await(
        [&] { return bench.ask("GET", "/api/status").value("/print/prompt/text"_json_pointer, "") == text; },
        bench.daemon());
  };
  asks("Nozzle Parked");
  bench.ask("POST", "/api/print/answer", R"({"button": 0})");
  asks("Paused");
  bench.ask("POST", "/api/print/answer", R"({"button": 1})");
  bench.await_job(1, "done");
  await([&] { return times(events_in(log), "print_ended") == 1; }, bench.daemon());
  const std::vector<json> events = events_in(log);
  CAPTURE(test::read_text(log));
  CHECK(times(events, "print_started") == 1);
  CHECK(times(events, "paused") == 1);
  for (const char* question : {"Nozzle Parked", "Paused"}) {
    CHECK(std::count_if(events.begin(), events.end(), [&](const json& event) {
            return event["event"] == "question" && event.value("reason", "") == question;
          }) == 1);
  }
  CHECK(times(events, "problem") == 1);  // the cable
  CHECK(events.front()["event"] == "print_started");
  const json& last = events.back();
  CHECK(last["job"] == "plate.toml");
  CHECK(last["state"] == "done");
  CHECK(last["percent"] == 100);
  CHECK(last["text"] == "plate.toml has been printed");
  CHECK(last["filaments"].size() == 3);
}

TEST_CASE("a command that never ends delays neither the print nor the daemon's end") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve({"--on-event", "cat >> " + bench.path("events") + "; exec sleep 1000"});
  bench.ask("POST", "/api/jobs", R"({"job": "plate.toml", "layers": [0, 0]})");
  bench.ask("POST", "/api/print/start", "{}");
  bench.await_job(1, "done");
  CHECK(times(events_in(bench.path("events")), "print_started") == 1);
  CHECK(times(events_in(bench.path("events")), "print_ended") == 0);  // the first one still sleeps
  kill(bench.daemon().id(), SIGTERM);
  CHECK(bench.daemon().wait().code == 0);
}
