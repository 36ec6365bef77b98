// Which files a client may have printed: jobs in the folders that the daemon was started with, and what was
// uploaded. A client names them, and never a path of its own:
//
//   "leaf.toml", "animals/fish.toml"   a file in one of the folders, links followed, but not out of it
//   "upload:leaf/job.toml"             a file that was uploaded as part of "leaf"
//
// A job of the daemon's own folders may refer to any file, as its owner has written it. An uploaded one may
// refer to files beside it only: no text in it holds a slash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace unicursal::host {

inline constexpr std::uint64_t largest_upload = 64 * 1024 * 1024;   ///< bytes of one file
inline constexpr std::uint64_t most_uploaded = 1024 * 1024 * 1024;  ///< bytes of all together
inline constexpr std::size_t most_uploaded_files = 1000;
inline constexpr std::size_t most_listed_jobs = 1000;

/// Letters, digits, and . _ - not in front; at most 64 of them.
bool is_plain_name(const std::string& name);

class JobFiles {
 public:
  /// `uploads` is made when it is needed.
  JobFiles(std::vector<std::filesystem::path> folders, std::filesystem::path uploads);

  /// The file of a job, known to be one that may be opened. Throws Refused.
  std::filesystem::path find(const std::string& name) const;
  static bool is_upload(const std::string& name);
  /// Whether a job of this name is one of the upload's.
  static bool is_from(const std::string& name, const std::string& upload);
  /// Every job that find() would find.
  std::vector<std::string> list() const;

  /// Keeps one file of an upload, in place of an earlier one of the same name. Blocks. Throws Refused.
  void keep(const std::string& upload, const std::string& file, const std::string& bytes) const;
  /// Throws Refused.
  void remove(const std::string& upload) const;

 private:
  std::filesystem::path find_upload(const std::string& name) const;

  std::vector<std::filesystem::path> folders_;
  std::filesystem::path uploads_;
};

}  // namespace unicursal::host
