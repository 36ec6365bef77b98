// Files that are there whole or not at all: they are written under another name, with ".part" at its end,
// and renamed when they are complete and on the disk. So neither a reader nor an interrupted program nor a
// power cut finds half a file.
//
//   WholeFile file("out.gcode");
//   file.stream() << "G28\n";
//   file.publish();
//
// A device or a pipe, such as /dev/null, is written directly.
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "host/files/descriptor.hpp"

namespace unicursal::host {

class WholeFile {
 public:
  enum class Access {
    usual,      ///< as the umask says; the file behind a symbolic link is replaced, not the link
    as_before,  ///< like `usual`, with the permissions of the file that is replaced
    owner_only  ///< 0600; a symbolic link is replaced
  };

  /// Makes missing folders, and an empty file under the other name. Throws core::FileError.
  explicit WholeFile(std::filesystem::path file, Access access = Access::usual);
  /// Removes what was written unless it was published.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// Gives the file its name; once. Throws core::FileError if it could not be written to its end; what was
  /// there before is still there then.
  void publish();

 private:
  void discard() noexcept;

  std::filesystem::path file_, target_, draft_;  ///< the last two are equal if it is written directly
  Descriptor descriptor_;                        ///< of the draft, to sync it
  std::ofstream stream_;
};

/// The same in one step.
void write_whole_file(const std::filesystem::path& file, std::string_view content,
                      WholeFile::Access access = WholeFile::Access::usual);

/// Makes new names in a folder survive a power cut; best effort.
void sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace unicursal::host
