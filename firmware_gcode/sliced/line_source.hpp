// The lines of a text file, one at a time, however it ends them and however long they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::gcode {

class LineSource {
 public:
  static constexpr std::size_t longest_command = 4096;   ///< bytes of a line before its comment
  static constexpr std::size_t longest_comment = 65536;  ///< bytes; the rest is cut off

  /// `file` is read from where it stands and must outlive this object. `name` is for messages.
  LineSource(std::istream& file, std::string name);

  /// The next line without its end; it is valid until the next call. nullopt at the end. Throws
  /// core::DataError for a command that is too long, a file that is not text, and core::FileError if it
  /// cannot be read.
  std::optional<std::string_view> next();
  /// Of the line given last, from 1.
  std::uint64_t number() const { return number_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  bool fill();
  void take(std::string_view piece);
  void check(std::string_view line) const;

  std::istream& file_;
  std::string name_;
  std::string buffer_;
  std::size_t at_ = 0;
  std::string line_;
  bool in_comment_ = false;
  std::uint64_t number_ = 0, bytes_ = 0;
};

}  // namespace unicursal::gcode
