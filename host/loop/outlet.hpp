// Text for a terminal, a pipe or a log, written by a thread of its own, so that nobody waits who must not: a
// terminal can be halted with Ctrl-S, and a pipe is full when its reader sleeps. A print that waited for
// either would stand with its hot nozzle on the part.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace unicursal::host {

class Outlet {
 public:
  /// Returns the text that stands for `count` texts that were lost.
  using Gap = std::function<std::string(std::size_t count)>;

  /// Texts that wait take at most this many bytes together; later ones are lost, and counted.
  static constexpr std::size_t most_bytes = 16U << 20U;

  /// Writes to `descriptor`, which must stay open for as long as the process lives.
  Outlet(int descriptor, Gap gap);
  /// Waits until everything has been written, but not for longer than `patience`: what is left then is
  /// written later, or never.
  ~Outlet();
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  /// Never waits. A descriptor that is closed or broken takes nothing, without a complaint.
  void write(std::string text);
  /// The same for a text that only shows how things stand: it takes the place of the last one like it if that
  /// still waits, and nothing has been written after it.
  void refresh(std::string text);

  static constexpr std::chrono::seconds patience{2};

 private:
  struct Shared;

  std::shared_ptr<Shared> shared_;
};

}  // namespace unicursal::host
