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
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/daemon/upload_draft.hpp"

namespace unicursal::host {

inline constexpr std::uint64_t gigabyte = 1024 * 1024 * 1024;
inline constexpr std::uint64_t largest_upload = 64 * 1024 * 1024;  ///< bytes of one file that is sent alone
inline constexpr std::uint64_t largest_form = gigabyte;            ///< bytes of a form with a file in it
inline constexpr std::uint64_t most_uploaded = 4 * gigabyte;       ///< bytes of all uploads together
/// Bytes of the disk that uploads leave to prints and the queue.
inline constexpr std::uint64_t left_on_disk = 64 * 1024 * 1024;
inline constexpr std::size_t most_uploaded_files = 1000;
inline constexpr std::size_t most_listed_jobs = 1000;

/// A file that can be queued, by the name that OctoPrint's clients know it by: "leaf.stl" for
/// "upload:leaf/leaf.stl"; "animals/fish.toml" as it is. Other uploads have none.
struct LocalFile {
  std::string name, job;
  std::uint64_t size = 0;  ///< bytes
  std::int64_t date = 0;   ///< s since 1970
};

/// Absent: the job has no such name.
std::optional<std::string> local_name(const std::string& job);

class JobFiles {
 public:
  /// The folder `uploads` is made when it is needed.
  JobFiles(std::vector<std::filesystem::path> folders, std::filesystem::path uploads);

  /// The file of a job, which may be opened. Throws Refused.
  std::filesystem::path find(const std::string& name) const;
  /// The name of a file in one of the folders; empty: it lies elsewhere, or is not there.
  std::string name_of(const std::filesystem::path& file) const;
  static bool is_upload(const std::string& name);
  /// "leaf" for "upload:leaf/job.toml".
  static std::string upload_of(const std::string& job);
  /// Whether a job of this name belongs to the upload.
  static bool is_from(const std::string& name, const std::string& upload);
  /// The names of all jobs that find() would find, in order.
  std::vector<std::string> list() const;

  /// Keeps one file of an upload; replaces an earlier one of the same name. Blocks. Throws Refused.
  void keep(const std::string& upload, const std::string& file, const std::string& bytes) const;
  /// The same for a file that arrives piece by piece. Throws Refused if it has no room; `bytes`: of it.
  std::unique_ptr<UploadDraft> draft(std::uint64_t bytes) const;
  /// Keeps a complete one under a plain name, and returns the job's name. An upload of the same name is
  /// replaced, unless it has other files or is `needed`; then a number is added. Blocks. Throws Refused.
  std::string adopt(UploadDraft& draft, const std::string& file,
                    const std::function<bool(const std::string& upload)>& needed) const;
  /// Throws Refused.
  void remove(const std::string& upload) const;
  /// In order of their names. Blocks.
  std::vector<LocalFile> local_files() const;
  /// Throws Refused.
  LocalFile local_file(const std::string& name) const;
  std::uint64_t free_bytes() const;

 private:
  std::filesystem::path find_upload(const std::string& name) const;
  void check_room(std::uint64_t bytes) const;

  std::vector<std::filesystem::path> folders_;
  std::filesystem::path uploads_;
};

}  // namespace unicursal::host
