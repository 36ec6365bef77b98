// Names from clients lead to allowed files only, and the queue outlives its daemon.
#include "host/daemon/job_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "host/daemon/queue.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/state_folder.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;
namespace fs = std::filesystem;
using Why = Refused::Why;

namespace {

class Folders {
 public:
  Folders() {
    fs::create_directories(folder / "jobs/animals");
    folder.write("jobs/leaf.toml", test::sample_job);
    folder.write("jobs/animals/fish.toml", test::sample_job);
    folder.write("jobs/notes.txt", "no job");
    folder.write("secret.toml", "secret = 1");
  }
  JobFiles files() const { return JobFiles({folder / "jobs"}, folder / "uploads"); }

  test::TempFolder folder;
};

std::optional<Why> refusal(const JobFiles& files, const std::string& name) {
  try {
    files.find(name);
  } catch (const Refused& error) {
    return error.why();
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("jobs in the folders are found by their names, and other files are not") {
  const Folders folders;
  fs::create_symlink(folders.folder / "secret.toml", folders.folder / "jobs/link.toml");
  fs::create_directory_symlink(folders.folder.path(), folders.folder / "jobs/up");
  folders.folder.write("jobs/star.3MF", "a model");
  folders.folder.write("jobs/bench.toml", test::sample_profile);
  const JobFiles files = folders.files();
  CHECK(refusal(files, "star.3MF") == std::nullopt);
  CHECK(files.find("leaf.toml") == fs::canonical(folders.folder / "jobs/leaf.toml"));
  CHECK(refusal(files, "animals/fish.toml") == std::nullopt);
  CHECK(refusal(files, "notes.txt") == Why::bad_name);
  CHECK(refusal(files, "missing.toml") == Why::not_found);
  CHECK(refusal(files, "../secret.toml") == Why::bad_name);
  CHECK(refusal(files, "animals/../../secret.toml") == Why::bad_name);
  CHECK(refusal(files, (folders.folder / "secret.toml").string()) == Why::bad_name);
  CHECK(refusal(files, "link.toml") == Why::not_found);
  CHECK(refusal(files, "up/secret.toml") == Why::not_found);
  CHECK(refusal(files, std::string("leaf.toml\0.toml", 15)) == Why::bad_name);
  CHECK(refusal(files, "") == Why::bad_name);
  CHECK(files.list() == std::vector<std::string>{"animals/fish.toml", "leaf.toml", "star.3MF"});
}

TEST_CASE("an upload is one folder of files, and its job can name no others") {
  const Folders folders;
  const JobFiles files = folders.files();
  files.keep("leaf", "job.toml", test::sample_job);
  CHECK(files.find("upload:leaf/job.toml") == folders.folder / "uploads/leaf/job.toml");
  CHECK(test::read_text(files.find("upload:leaf/job.toml")) == test::sample_job);
  CHECK(files.list().back() == "upload:leaf/job.toml");
  for (const char* name : {"upload:leaf", "upload:../job.toml", "upload:leaf/../../secret.toml",
                           "upload:/leaf/job.toml", "upload:.leaf/job.toml", "upload:leaf/job.txt"})
    CHECK(refusal(files, name) == Why::bad_name);
  for (const char* name : {"", ".", "..", "a/b", "-x", "a b", "ä"}) {
    CHECK_THROWS_AS(files.keep(name, "job.toml", ""), Refused);
    CHECK_THROWS_AS(files.keep("leaf", name, ""), Refused);
    CHECK_THROWS_AS(files.remove(name), Refused);
  }
  CHECK_THROWS_AS(files.keep("leaf", "job.toml.part", ""), Refused);
  files.keep("bad", "a.toml", test::replaced(test::sample_job, "plate.svg", "../../secret.toml"));
  files.keep("bad", "b.toml", test::replaced(test::sample_job, "\"bench.toml\"", "\"/etc/hostname\""));
  files.keep("bad", "c.toml", "this is no TOML");
  for (const char* name : {"upload:bad/a.toml", "upload:bad/b.toml", "upload:bad/c.toml"})
    CHECK(refusal(files, name) == Why::bad_job);
  files.remove("leaf");
  CHECK(refusal(files, "upload:leaf/job.toml") == Why::not_found);
}

TEST_CASE("the queue is found again, and the job that was being printed is interrupted") {
  const test::TempFolder folder;
  const fs::path file = folder / "queue.json";
  Queue queue(file);
  const auto first = queue.add("a.toml", LayerRange{1, 3});
  const auto second = queue.add("b.toml", {}), third = queue.add("c.toml", {});
  queue.enter(first, QueuedJob::State::printing);
  queue.remove(third);
  write_state(file, queue.text());
  Queue again(file);
  REQUIRE(again.jobs().size() == 2);
  CHECK(again.find(first)->state == QueuedJob::State::interrupted);
  CHECK(again.find(first)->layers->last == 3);
  CHECK(again.next()->id == second);
  CHECK(again.add("d.toml", {}) == third + 1);  // numbers are never used twice
  folder.write("queue.json", "{\"jobs\": 7}");
  CHECK_THROWS_AS(Queue(file), DaemonError);
}

TEST_CASE("uploads are listed also when the state folder was named by a relative path") {
  const Folders folders;
  const JobFiles files({folders.folder / "jobs"}, fs::relative(folders.folder / "uploads"));
  files.keep("leaf", "leaf.svg", test::sample_drawing);
  CHECK(files.list() == std::vector<std::string>{"animals/fish.toml", "leaf.toml", "upload:leaf/leaf.svg"});
  CHECK(files.local_file("leaf.svg").job == "upload:leaf/leaf.svg");
}

TEST_CASE("the last jobs that have ended are kept") {
  const test::TempFolder folder;
  Queue queue(folder / "queue.json");
  const auto waiting = queue.add("waits.toml", {});
  for (std::size_t i = 0; i < Queue::most_kept + 5; ++i)
    queue.enter(queue.add("a.toml", {}), QueuedJob::State::done);
  CHECK(queue.jobs().size() == Queue::most_kept + 1);
  CHECK(queue.find(waiting));
  CHECK_FALSE(queue.find(waiting + 1));
  CHECK(queue.jobs().back().id == waiting + Queue::most_kept + 5);
}

TEST_CASE("a state folder that others can write to is refused") {
  const test::TempFolder folder;
  const std::string path = folder / "state";
  REQUIRE(mkdir(path.c_str(), 0700) == 0);
  for (const mode_t mode : {0777, 0770, 01777, 0702}) {
    REQUIRE(chmod(path.c_str(), mode) == 0);
    CHECK_THROWS_WITH(StateFolder(path), Catch::Contains("only this user"));
  }
  REQUIRE(chmod(path.c_str(), 0755) == 0);
  CHECK_NOTHROW(StateFolder(path));
  if (geteuid() == 0) {
    REQUIRE(chown(path.c_str(), 1000, 1000) == 0);
    CHECK_THROWS_WITH(StateFolder(path), Catch::Contains("only this user"));
  }
}

TEST_CASE("a state folder belongs to one daemon, and its secrets to their owner") {
  const test::TempFolder folder;
  const StateFolder state(folder / "state");
  CHECK_THROWS_AS(StateFolder(folder / "state"), DaemonError);
  const std::string token = state.secret("token");
  CHECK(state.secret("token") == token);
  CHECK(state.secret("metrics-token") != token);
  struct stat found {};
  REQUIRE(stat((folder / "state/token").c_str(), &found) == 0);
  CHECK((found.st_mode & 0777) == 0600);
  REQUIRE(chmod((folder / "state/token").c_str(), 0644) == 0);
  CHECK_THROWS_AS(state.secret("token"), DaemonError);
}
