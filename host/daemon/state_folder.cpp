#include "host/daemon/state_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "host/daemon/secret.hpp"
#include "host/files/state_home.hpp"
#include "host/files/whole_file.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

DaemonError trouble(const fs::path& file, const std::string& what) {
  const int number = errno;
  return {file.string(), "", what + " (" + std::strerror(number) + ")",
          "check the permissions and the space on the disk, or name another folder with --state"};
}

}  // namespace

StateFolder::StateFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_.parent_path(), error);
  if (mkdir(folder_.c_str(), 0700) != 0 && errno != EEXIST) throw trouble(folder_, "cannot be made");
  // Whoever else can write there could have put a token or a queue of his own into it.
  struct stat found {};
  if (stat(folder_.c_str(), &found) != 0) throw trouble(folder_, "cannot be examined");
  if (!S_ISDIR(found.st_mode) || found.st_uid != geteuid() || (found.st_mode & 022) != 0)
    throw DaemonError(folder_.string(), "", "is not a folder that only this user can write to",
                      "make it yours with chown and chmod 700, or name another folder with --state");
  const fs::path lock = folder_ / "lock";
  lock_.reset(open(lock.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
  if (!lock_) throw trouble(lock, "cannot be opened");
  if (flock(lock_.get(), LOCK_EX | LOCK_NB) != 0) {
    throw DaemonError(folder_.string(), "", "another daemon runs there",
                      "see `unicursal status`, or name another folder with --state");
  }
}

StateFolder::~StateFolder() {
  remove_address();
}

void StateFolder::remove_address() const noexcept {
  std::error_code ignored;
  fs::remove(folder_ / "address", ignored);
  fs::remove(folder_ / "socket", ignored);
}

std::string StateFolder::secret(const std::string& name) const {
  const fs::path file = folder_ / name;
  struct stat found {};
  if (lstat(file.c_str(), &found) == 0) {
    if (!S_ISREG(found.st_mode) || found.st_uid != geteuid() || (found.st_mode & 077) != 0) {
      throw DaemonError(file.string(), "", "is a secret that others made or may read",
                        "delete it, and a new one is made; or chmod 600 it");
    }
    if (const auto known = read_line(file); known && known->size() >= 32) return *known;
  }
  return renewed(name);
}

std::string StateFolder::renewed(const std::string& name) const {
  std::string token = random_token();
  write_state(folder_ / name, token + "\n");
  return token;
}

void StateFolder::write_address(const std::string& address) const {
  write_state(folder_ / "address", address + "\n");
}

fs::path default_state_folder() {
  if (const auto home = state_home()) return *home / "daemon";
  throw DaemonError("", "", "there is no home folder to keep the daemon's state in",
                    "name a folder with --state");
}

void write_state(const fs::path& file, const std::string& text) {
  try {
    write_whole_file(file, text, WholeFile::Access::owner_only);
  } catch (const core::FileError& error) {
    throw DaemonError(error.file(), "", error.problem(),
                      "check the permissions and the space on the disk, or name another folder with --state");
  }
}

std::optional<std::string> read_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line) || line.empty()) return std::nullopt;
  return line;
}

}  // namespace unicursal::host
