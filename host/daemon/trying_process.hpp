// `unicursal dry-run` as a child of the daemon: of the lowest priority, within limits of memory and processor
// time, with its events and its errors on one pipe.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "host/files/descriptor.hpp"

namespace unicursal::host {

class TryingProcess {
 public:
  /// `words`: of the command, the program's name first. Throws std::system_error.
  explicit TryingProcess(std::vector<std::string> words);
  /// Kills it.
  ~TryingProcess();
  TryingProcess(const TryingProcess&) = delete;
  TryingProcess& operator=(const TryingProcess&) = delete;

  int release_output() { return read_end_.release(); }
  /// Lets it clear up behind it.
  void end() const;
  void kill() const;
  /// As waitpid() gives it. Only when the child has closed its output.
  int wait();
  /// Somebody has asked for its end.
  bool ended() const { return ended_; }

 private:
  Descriptor read_end_;
  pid_t id_ = -1;
  mutable bool ended_ = false;
};

}  // namespace unicursal::host
