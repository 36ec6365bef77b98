#include "host/loop/stay_awake.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <csignal>
#include <mutex>
#include <thread>
#include <utility>

namespace unicursal::host {
namespace {

constexpr std::uint64_t longest_call = 10'000'000;  ///< µs

struct CloseBus {
  void operator()(sd_bus* bus) const { sd_bus_flush_close_unref(bus); }
};
struct FreeMessage {
  void operator()(sd_bus_message* message) const { sd_bus_message_unref(message); }
};

/// Returns the descriptor that holds the lock; −1 without logind.
int take_lock(const std::string& why) {
  sd_bus* opened = nullptr;
  if (sd_bus_open_system(&opened) < 0) return -1;
  const std::unique_ptr<sd_bus, CloseBus> bus(opened);
  sd_bus_set_method_call_timeout(bus.get(), longest_call);
  sd_bus_message* answered = nullptr;
  const int result = sd_bus_call_method(bus.get(), "org.freedesktop.login1", "/org/freedesktop/login1",
                                        "org.freedesktop.login1.Manager", "Inhibit", nullptr, &answered,
                                        "ssss", "sleep:idle", "unicursal", why.c_str(), "block");
  const std::unique_ptr<sd_bus_message, FreeMessage> answer(answered);
  int descriptor = -1;
  if (result < 0 || sd_bus_message_read(answer.get(), "h", &descriptor) < 0) return -1;
  return fcntl(descriptor, F_DUPFD_CLOEXEC, 3);  // the message keeps its own
}

}  // namespace

/// Belongs to both threads.
struct StayAwake::Lock {
  std::mutex mutex;
  bool wanted = true;
  int descriptor = -1;

  void take(const std::string& why) {
    const int taken = take_lock(why);
    const std::lock_guard guard(mutex);
    if (wanted)
      descriptor = taken;
    else if (taken >= 0)
      ::close(taken);
  }
};

StayAwake::StayAwake(std::string why) : lock_(std::make_shared<Lock>()) {
  // Signals are for the thread that runs the print.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([lock = lock_, why = std::move(why)] { lock->take(why); }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

StayAwake::~StayAwake() {
  const std::lock_guard guard(lock_->mutex);
  lock_->wanted = false;
  if (lock_->descriptor >= 0) ::close(lock_->descriptor);
}

}  // namespace unicursal::host
