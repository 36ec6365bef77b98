// Splits bytes from a printer into lines of bounded length.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace unicursal::host {

class LineSplitter {
 public:
  /// Longest line, bytes; the rest of a longer one is dropped. No firmware writes so long a line; noise may.
  static constexpr std::size_t longest = 4096;

  /// Calls `take(std::string_view)` with every line that `bytes` completes, without its newline.
  template <class Take>
  void feed(std::string_view bytes, Take&& take) {
    for (auto end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
      keep(bytes.substr(0, end));
      take(std::string_view(line_));
      line_.clear();
      bytes.remove_prefix(end + 1);
    }
    keep(bytes);
  }

 private:
  void keep(std::string_view bytes) { line_ += bytes.substr(0, longest - line_.size()); }

  std::string line_;
};

}  // namespace unicursal::host
