#include "host/report/draft.hpp"

#include "core/error.hpp"

namespace unicursal::host {

std::filesystem::path draft_of(const std::filesystem::path& file) {
  return file.string() + ".part";
}

std::ofstream open_draft(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw core::FileError(file.string(), "", "is a folder", "name a file");
  }
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  std::ofstream stream(draft_of(file), std::ios::binary | std::ios::trunc);
  if (!stream) {
    throw core::FileError(file.string(), "", "cannot be written", "check the folder and its permissions");
  }
  return stream;
}

void publish_draft(std::ofstream& stream, const std::filesystem::path& file) {
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(draft_of(file), file, error);
  if (stream && !error) return;
  std::filesystem::remove(draft_of(file), error);
  throw core::FileError(file.string(), "", "could not be written to its end",
                        "check that the disk is not full");
}

}  // namespace unicursal::host
