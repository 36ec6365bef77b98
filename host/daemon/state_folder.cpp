#include "host/daemon/state_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "host/daemon/access.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

DaemonError trouble(const fs::path& file, const std::string& what) {
  const int number = errno;
  return {file.string(), "", what + " (" + std::strerror(number) + ")",
          "check the permissions and the space on the disk, or name another folder with --state"};
}

void write_all(int fd, const std::string& text, const fs::path& file) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(fd, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw trouble(file, "cannot be written");
    done += static_cast<std::size_t>(written);
  }
  if (fsync(fd) != 0) throw trouble(file, "cannot be written");
}

struct Descriptor {
  explicit Descriptor(int number) : fd(number) {}
  ~Descriptor() {
    if (fd >= 0) close(fd);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd;
};

}  // namespace

StateFolder::StateFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_.parent_path(), error);
  if (mkdir(folder_.c_str(), 0700) != 0 && errno != EEXIST) throw trouble(folder_, "cannot be made");
  const fs::path lock = folder_ / "lock";
  lock_ = open(lock.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  if (lock_ < 0) throw trouble(lock, "cannot be opened");
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(std::exchange(lock_, -1));
    throw DaemonError(folder_.string(), "", "another daemon runs there",
                      "see `unicursal status`, or name another folder with --state");
  }
}

StateFolder::~StateFolder() {
  std::error_code ignored;
  fs::remove(folder_ / "address", ignored);
  if (lock_ >= 0) close(lock_);
}

std::string StateFolder::secret(const std::string& name) const {
  const fs::path file = folder_ / name;
  struct stat found {};
  if (lstat(file.c_str(), &found) == 0) {
    if (!S_ISREG(found.st_mode) || (found.st_mode & 077) != 0) {
      throw DaemonError(file.string(), "", "is a secret that others may read",
                        "delete it, and a new one is made; or chmod 600 it");
    }
    if (const auto known = read_line(file); known && known->size() >= 32) return *known;
  }
  std::string token = random_token();
  replace_file(file, token + "\n");
  return token;
}

void StateFolder::tell_address(const std::string& address) const {
  replace_file(folder_ / "address", address + "\n");
}

fs::path default_state_folder() {
  return default_spool_root().parent_path() / "daemon";
}

void replace_file(const fs::path& file, const std::string& text) {
  const fs::path fresh = file.string() + ".new";
  std::error_code ignored;
  fs::remove(fresh, ignored);
  {
    const Descriptor out(open(fresh.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (out.fd < 0) throw trouble(fresh, "cannot be made");
    try {
      write_all(out.fd, text, fresh);
    } catch (const DaemonError&) {
      fs::remove(fresh, ignored);  // half a file is no use, and takes room that is scarce
      throw;
    }
  }
  if (rename(fresh.c_str(), file.c_str()) != 0) throw trouble(file, "cannot be replaced");
  const Descriptor folder(open(file.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.fd >= 0) fsync(folder.fd);
}

std::optional<std::string> read_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line) || line.empty()) return std::nullopt;
  return line;
}

}  // namespace unicursal::host
