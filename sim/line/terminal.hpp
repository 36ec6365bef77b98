// The pseudo-terminal at whose other end the host sits. The simulator holds the master; it never reads while
// no host has the slave open, so it never meets the error that an orphaned master gives.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace unicursal::sim {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int get() const { return number_; }

 private:
  int number_;
};

class Terminal {
 public:
  /// `link`: a symbolic link to make to the terminal. One that is in the way is replaced when it is a link to
  /// a terminal or to nothing. Throws std::system_error when a file is in the way or nothing can be made.
  explicit Terminal(std::optional<std::filesystem::path> link);
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// What a host opens: /dev/pts/N.
  const std::string& path() const { return path_; }
  int master() const { return master_.get(); }
  /// Becomes readable when somebody opens the terminal.
  int openings() const { return openings_.get(); }
  void forget_openings();
  /// A host has the terminal open, or has left something to read.
  bool host_present() const;
  /// What the host has sent, empty when there is nothing now; nothing when it has hung up and all was read.
  std::optional<std::string> read();
  /// Hands over what fits and takes it off `bytes`.
  void write(std::string& bytes);
  /// Whether the line drops DTR when it is closed, so that the next opening resets many boards.
  bool drops_dtr() const;
  /// Drops what a host has left unread, so that the next one starts afresh.
  void clear();

 private:
  void make_link();

  Descriptor master_, openings_;
  std::string path_;
  std::optional<std::filesystem::path> link_;
};

}  // namespace unicursal::sim
