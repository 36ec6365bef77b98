// The pseudo-terminal that connects simulator and host. The simulator holds the master side. It never reads
// while no host has the slave side open, so it never gets the error of a master without a slave.
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
  /// `link` is a symbolic link to make to the terminal. An existing link to a terminal and a dangling link
  /// are replaced. Throws std::system_error if another file is in the way or the terminal cannot be made.
  explicit Terminal(std::optional<std::filesystem::path> link);
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// The path that a host opens: /dev/pts/N.
  const std::string& path() const { return path_; }
  int master() const { return master_.get(); }
  /// A descriptor that becomes readable when a host opens the terminal.
  int openings() const { return openings_.get(); }
  void forget_openings();
  /// Whether a host has the terminal open, or has left bytes to read.
  bool host_present() const;
  /// Returns the bytes that the host has sent, perhaps none; nullopt if it has hung up and all were read.
  std::optional<std::string> read();
  /// Writes as many bytes as fit and removes them from `bytes`.
  void write(std::string& bytes);
  /// Whether closing the line drops DTR, so that the next opening resets many boards.
  bool drops_dtr() const;
  /// Discards the bytes that a host has not read, so that the next host does not get them.
  void clear();

 private:
  void make_link();

  Descriptor master_, openings_;
  std::string path_;
  std::optional<std::filesystem::path> link_;
};

}  // namespace unicursal::sim
