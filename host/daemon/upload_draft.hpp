// A file that arrives piece by piece. It has no name until it is complete and on the disk, and leaves nothing
// behind if it never is. Its functions block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "host/files/descriptor.hpp"

namespace unicursal::host {

class UploadDraft {
 public:
  /// Makes the folder if it is missing. Throws Refused.
  explicit UploadDraft(const std::filesystem::path& folder);
  ~UploadDraft();
  UploadDraft(const UploadDraft&) = delete;
  UploadDraft& operator=(const UploadDraft&) = delete;

  /// Throws Refused.
  void write(std::string_view bytes);
  std::uint64_t size() const { return size_; }
  /// Gives it a name, which must be in the same file system; once. A file of that name is replaced. Throws
  /// Refused.
  void publish(const std::filesystem::path& file);

  /// Removes drafts that a dead daemon has left in the folder.
  static void remove_old(const std::filesystem::path& folder) noexcept;

 private:
  std::filesystem::path draft_;  ///< empty once it has a name
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace unicursal::host
