// The files that a client may have printed: jobs in the folders that the daemon was started with, and
// uploads. A client names them as follows; it cannot name other paths:
//
//   "leaf.toml", "animals/fish.toml"   a file in one of the folders, links followed, but not out of it
//   "upload:leaf/job.toml"             a file that was uploaded as part of "leaf"
//
// A model, such as "leaf.svg", or a slicer's G-code is a job, too: it is printed with the usual settings.
//
// A job in the daemon's folders may refer to any file. An uploaded job may only refer to files beside it:
// none of its texts may contain a slash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace unicursal::host {

inline constexpr std::uint64_t largest_upload = 64 * 1024 * 1024;   ///< bytes of one file
inline constexpr std::uint64_t most_uploaded = 1024 * 1024 * 1024;  ///< bytes of all uploads together
inline constexpr std::size_t most_uploaded_files = 1000;
inline constexpr std::size_t most_listed_jobs = 1000;

/// Whether a name has 1 to 64 letters, digits, dots, dashes and underscores, the first not a dot or a dash.
bool is_plain_name(const std::string& name);

class JobFiles {
 public:
  /// The folder `uploads` is made when it is needed.
  JobFiles(std::vector<std::filesystem::path> folders, std::filesystem::path uploads);

  /// The file of a job, which may be opened. Throws Refused.
  std::filesystem::path find(const std::string& name) const;
  static bool is_upload(const std::string& name);
  /// Whether a job of this name belongs to the upload.
  static bool is_from(const std::string& name, const std::string& upload);
  /// The names of all jobs that find() would find, in order.
  std::vector<std::string> list() const;

  /// Keeps one file of an upload; replaces an earlier one of the same name. Blocks. Throws Refused.
  void keep(const std::string& upload, const std::string& file, const std::string& bytes) const;
  /// Throws Refused.
  void remove(const std::string& upload) const;

 private:
  std::filesystem::path find_upload(const std::string& name) const;

  std::vector<std::filesystem::path> folders_;
  std::filesystem::path uploads_;
};

}  // namespace unicursal::host
