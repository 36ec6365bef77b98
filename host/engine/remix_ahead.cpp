#include "host/engine/remix_ahead.hpp"

#include <algorithm>
#include <utility>

#include "core/stopping.hpp"

namespace unicursal::host {
namespace {

// One of these is enough to wait, once two chunks are there.
constexpr double most_seconds = 60;  ///< of printing
constexpr std::size_t most_chunks = 64;
constexpr std::size_t most_lines = 100000;

}  // namespace

void RemixAhead::begin() {
  thread_ = std::jthread([this](const std::stop_token& over) { run(over); });
}

bool RemixAhead::is_full() const {
  return made_.size() >= 2 &&
         (made_.size() >= most_chunks || seconds_ >= most_seconds || lines_ >= most_lines);
}

void RemixAhead::run(const std::stop_token& over) {
  const core::StopScope scope(over);
  for (;;) {
    std::optional<RemixedChunk> next;
    std::exception_ptr failed;
    try {
      if (auto chunk = remix_.next())
        next = RemixedChunk{std::move(*chunk), remix_.wanted(), remix_.seen(), remix_.left_out()};
    } catch (...) {
      failed = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    if (next) {
      seconds_ += next->chunk.seconds;
      lines_ += next->chunk.lines.size();
      made_.push_back(std::move(*next));
      most_ = std::max(most_, made_.size());
    } else {
      ended_ = true;
      failed_ = failed;
    }
    changed_.notify_all();
    if (listener_) listener_();
    if (ended_ || !changed_.wait(lock, over, [this] { return !is_full(); })) return;
  }
}

std::optional<RemixedChunk> RemixAhead::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ended_ || !made_.empty(); });
  if (made_.empty()) {
    if (failed_) std::rethrow_exception(failed_);
    return std::nullopt;
  }
  RemixedChunk next = std::move(made_.front());
  made_.pop_front();
  seconds_ -= next.chunk.seconds;
  lines_ -= next.chunk.lines.size();
  changed_.notify_all();
  return next;
}

bool RemixAhead::ready() const {
  const std::lock_guard lock(mutex_);
  return ended_ || !made_.empty();
}

void RemixAhead::on_ready(std::function<void()> listener) {
  const std::lock_guard lock(mutex_);
  listener_ = std::move(listener);
}

void RemixAhead::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  const std::lock_guard lock(mutex_);
  made_.clear();
  seconds_ = 0;
  lines_ = 0;
  ended_ = true;
  failed_ = nullptr;
}

Waiting RemixAhead::waiting() const {
  const std::lock_guard lock(mutex_);
  Waiting waiting{0, seconds_};
  for (const RemixedChunk& made : made_) {
    for (const gcode::LayerShare& share : made.chunk.layers) waiting.layers += share.last ? 1 : 0;
  }
  return waiting;
}

std::size_t RemixAhead::most_waiting() const {
  const std::lock_guard lock(mutex_);
  return most_;
}

}  // namespace unicursal::host
