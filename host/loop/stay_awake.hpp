// Keeps this computer from going to sleep during a print: a sleeping computer leaves the hot nozzle standing
// on the part. It asks systemd-logind for an inhibitor lock (org.freedesktop.login1(5), method Inhibit, what
// "sleep:idle", mode "block"; systemd's document "Inhibitor Locks"). On a computer without logind nothing
// puts it to sleep behind the user's back, and nothing is done.
#pragma once

#include <memory>
#include <string>

namespace unicursal::host {

class StayAwake {
 public:
  /// `why` is what the desktop shows. Never waits: the lock is taken by a thread of its own.
  explicit StayAwake(std::string why);
  /// Gives the lock back.
  ~StayAwake();
  StayAwake(const StayAwake&) = delete;
  StayAwake& operator=(const StayAwake&) = delete;

 private:
  struct Lock;

  std::shared_ptr<Lock> lock_;
};

}  // namespace unicursal::host
