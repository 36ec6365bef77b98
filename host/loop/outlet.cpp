#include "host/loop/outlet.hpp"

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

namespace unicursal::host {
namespace {

struct Text {
  std::string bytes;
  bool transient = false;
};

/// Returns false if the descriptor takes nothing any more.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (count < 0 && errno == EAGAIN) {
      pollfd ready{descriptor, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (count == 0 || errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace

/// Belongs to both threads; the writing one may live longer than the Outlet.
struct Outlet::Shared {
  Shared(int to, Gap with) : descriptor(to), gap(std::move(with)) {}

  const int descriptor;
  const Gap gap;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Text> waiting;
  std::size_t bytes = 0;  ///< of `waiting`
  std::size_t lost = 0;   ///< texts, since the last one that found room
  bool ends = false;
  bool done = false;

  void put(Text text);
  void run();
};

void Outlet::Shared::put(Text text) {
  {
    const std::lock_guard lock(mutex);
    if (text.transient && !waiting.empty() && waiting.back().transient) {
      bytes -= waiting.back().bytes.size();
      waiting.pop_back();
    }
    if (bytes + text.bytes.size() > most_bytes) {
      if (!text.transient) ++lost;
      return;
    }
    if (lost > 0) {
      waiting.push_back({gap(std::exchange(lost, 0)), false});
      bytes += waiting.back().bytes.size();
    }
    bytes += text.bytes.size();
    waiting.push_back(std::move(text));
  }
  changed.notify_all();
}

void Outlet::Shared::run() {
  std::unique_lock lock(mutex);
  for (bool open = true;;) {
    changed.wait(lock, [&] { return ends || !waiting.empty(); });
    if (waiting.empty() && lost > 0) waiting.push_back({gap(std::exchange(lost, 0)), false});
    if (waiting.empty()) break;
    const Text text = std::move(waiting.front());
    waiting.pop_front();
    bytes -= std::min(bytes, text.bytes.size());
    lock.unlock();
    open = open && write_all(descriptor, text.bytes);
    lock.lock();
  }
  done = true;
  changed.notify_all();
}

Outlet::Outlet(int descriptor, Gap gap) : shared_(std::make_shared<Shared>(descriptor, std::move(gap))) {
  // Signals are for the thread that runs the print.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([shared = shared_] { shared->run(); }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Outlet::~Outlet() {
  std::unique_lock lock(shared_->mutex);
  shared_->ends = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, patience, [&] { return shared_->done; });
}

void Outlet::write(std::string text) {
  shared_->put({std::move(text), false});
}

void Outlet::refresh(std::string text) {
  shared_->put({std::move(text), true});
}

}  // namespace unicursal::host
