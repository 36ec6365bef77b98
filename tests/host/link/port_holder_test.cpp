// Refusals of a port name the program that stands in the way.
#include "host/link/port_holder.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;

namespace {

/// A process of this name that does nothing.
class Named {
 public:
  Named(const std::filesystem::path& folder, const std::string& name) {
    const std::filesystem::path program = folder / name;
    std::filesystem::copy_file("/bin/sleep", program);
    id_ = fork();
    REQUIRE(id_ >= 0);
    if (id_ == 0) {
      execl(program.c_str(), program.c_str(), "600", nullptr);
      _exit(127);
    }
  }
  ~Named() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Named(const Named&) = delete;
  Named& operator=(const Named&) = delete;

 private:
  pid_t id_ = -1;
};

}  // namespace

TEST_CASE("a port that has vanished while brltty runs is refused with its name") {
  const test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  folder.write("plate.svg", test::sample_drawing);
  folder.write("job.toml", test::sample_job);
  const Named brltty(folder.path(), "brltty");
  while (!host::brltty_runs()) poll(nullptr, 0, 1);  // until it has replaced the fork
  const test::Outcome print = test::run({"print", (folder / "job.toml").string(), "--port", "/dev/ttyUSB77"});
  CHECK(print.code == 2);
  CHECK(print.err.find("brltty") != std::string::npos);
  CHECK(print.err.find("sudo apt remove brltty") != std::string::npos);
}

TEST_CASE("a port that another program has open is refused with the name of that program") {
  const test::TempFolder folder;
  folder.write("bench.toml", test::tall_profile());
  folder.write("plate.svg", test::sample_drawing);
  folder.write("job.toml", test::tall_job());
  const auto path = [&](const char* name) { return (folder / name).string(); };
  test::Child printer({"simulate", "--profile", path("bench.toml"), "--link", path("port"), "--speed", "20",
                       "--transcript", path("lines")});
  test::await([&] { return std::filesystem::exists(folder / "port"); }, printer);
  test::Child first({"print", path("job.toml"), "--port", path("port"), "--spool", path("spool")});
  test::await([&] { return test::read_text(folder / "lines").find("M115") != std::string::npos; }, first);

  const test::Outcome second =
      test::run({"print", path("job.toml"), "--port", path("port"), "--spool", path("spool2")});
  CHECK(second.code == 2);
  CHECK(second.err.find("unicursal (process ") != std::string::npos);
  CHECK(second.err.find("is using it; close that program first") != std::string::npos);
}
