// Reads files out of a ZIP archive (libzip), within limits: archives come from strangers, and a few kilobytes
// can unpack to terabytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::core {

inline constexpr std::uint64_t largest_unpacked = 512u << 20;  ///< bytes of one file
inline constexpr std::uint64_t most_unpacked = 1024u << 20;    ///< bytes of all files together

bool is_zip(std::string_view bytes);

class ZipArchive {
 public:
  /// `bytes` must outlive the archive; `file` is for messages. Throws ModelError.
  ZipArchive(std::string_view bytes, std::string file);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  std::vector<std::string> names() const;
  /// The content of a file; nullopt if it is absent. Names are compared without case, as OPC demands. Throws
  /// ModelError for damage and for what is too large.
  std::optional<std::string> content(const std::string& name);

 private:
  struct Handle;
  std::string file_;
  std::unique_ptr<Handle> handle_;
  std::uint64_t unpacked_ = 0;
};

}  // namespace unicursal::core
