#include "host/dry_run/simulator_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

namespace unicursal::host {
namespace {

constexpr int start_deadline =
    20000;  // ms until the simulator names its terminal; generous for a busy computer
constexpr std::size_t longest_port = 4096;
constexpr int raster_descriptor = STDERR_FILENO + 1;  // of the child

std::filesystem::path make_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "unicursal-XXXXXX").string();
  if (!mkdtemp(name.data())) throw SimulatorError("no temporary folder can be made; free some space in /tmp");
  return name;
}

std::filesystem::path report_in(const std::filesystem::path& folder) {
  return folder / "simulator.json";
}

/// Runs in the child: only calls that are safe after fork.
[[noreturn]] void become_simulator(char* const* arguments, int output, int rasters, pid_t parent) {
  setpgid(0, 0);  // Ctrl-C is for the host, which still has to park and cool this printer
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  const int copy = fcntl(rasters, F_DUPFD, raster_descriptor + 1);  // the place it goes to may be the other's
  dup2(output, STDOUT_FILENO);
  dup2(copy, raster_descriptor);
  close_range(raster_descriptor + 1, ~0U, 0);  // the report being written, for example
  execv("/proc/self/exe", arguments);
  _exit(127);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

SimulatorProcess::SimulatorProcess(const std::vector<std::string>& arguments, Time time)
    : folder_(make_folder()) {
  std::vector<std::string> all = {"unicursal", "simulate", "--once", "--report", report_in(folder_).string()};
  all.insert(all.end(), {"--rasters", fmt::format("/dev/fd/{}", raster_descriptor)});
  if (time == Time::lockstep) all.insert(all.end(), {"--control", control().string()});
  all.insert(all.end(), arguments.begin(), arguments.end());
  try {
    spawn(all);
    read_port();
  } catch (...) {
    clean_up();
    throw;
  }
}

SimulatorProcess::~SimulatorProcess() {
  clean_up();
}

void SimulatorProcess::clean_up() noexcept {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    wait_for(child_);
    child_ = -1;
  }
  for (int* end : {&output_, &rasters_}) {
    if (*end >= 0) close(*end);
    *end = -1;
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void SimulatorProcess::spawn(const std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  std::array<int, 2> words{}, rasters{};
  if (pipe2(words.data(), O_CLOEXEC) != 0) throw SimulatorError("the simulator's output cannot be read");
  output_ = words[0];
  if (pipe2(rasters.data(), O_CLOEXEC) != 0) {
    close(words[1]);
    throw SimulatorError("what the simulator lays cannot be read");
  }
  rasters_ = rasters[0];
  const pid_t parent = getpid();
  child_ = fork();
  if (child_ == 0) become_simulator(pointers.data(), words[1], rasters[1], parent);
  close(words[1]);
  close(rasters[1]);
  if (child_ < 0)
    throw SimulatorError(fmt::format("the simulator cannot be started: {}", std::strerror(errno)));
}

void SimulatorProcess::read_port() {
  std::string text;
  while (text.find('\n') == std::string::npos && text.size() < longest_port) {
    pollfd ready{output_, POLLIN, 0};
    const int polled = poll(&ready, 1, start_deadline);
    if (polled < 0 && errno == EINTR) continue;
    std::array<char, 256> buffer{};
    const ssize_t n = polled > 0 ? ::read(output_, buffer.data(), buffer.size()) : 0;
    if (n <= 0) throw SimulatorError("the simulator did not start");
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  port_ = text.substr(0, text.find('\n'));
}

int SimulatorProcess::take_rasters() {
  return std::exchange(rasters_, -1);
}

nlohmann::json SimulatorProcess::finish() {
  const int status = wait_for(child_);
  child_ = -1;
  if (WIFSIGNALED(status))
    throw SimulatorError(fmt::format("the simulator was ended by signal {}", WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) {
    throw SimulatorError(fmt::format("the simulator ended with exit code {}", WEXITSTATUS(status)));
  }
  std::ifstream stream(report_in(folder_));
  nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
  if (!report.is_object()) throw SimulatorError("the simulator left no readable report");
  return report;
}

}  // namespace unicursal::host
