#include "host/files/whole_file.hpp"

#include "core/error.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

/// A device, a pipe, a terminal: nothing that could be renamed over.
bool written_directly(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

/// The file behind symbolic links, also when it does not exist yet.
fs::path target_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(file, error))) return file;
  if (const fs::path whole = fs::canonical(file, error); !error) return whole;
  const fs::path next = fs::read_symlink(file, error);
  return error ? file : file.parent_path() / next;
}

}  // namespace

fs::path draft_of(const fs::path& file) {
  if (written_directly(file)) return file;
  return target_of(file).string() + ".part";
}

std::ofstream open_draft(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) {
    throw core::FileError(file.string(), "", "is a folder", "name a file");
  }
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  std::ofstream stream(draft_of(file), std::ios::binary | std::ios::trunc);
  if (!stream) {
    throw core::FileError(file.string(), "", "cannot be written", "check the folder and its permissions");
  }
  return stream;
}

void publish_draft(std::ofstream& stream, const fs::path& file) {
  const fs::path draft = draft_of(file);
  stream.close();
  std::error_code error;
  if (stream && draft != file) fs::rename(draft, target_of(file), error);
  if (stream && !error) return;
  discard_draft(stream, file);
  throw core::FileError(file.string(), "", "could not be written to its end",
                        "check that the disk is not full");
}

void discard_draft(std::ofstream& stream, const fs::path& file) noexcept {
  try {
    stream.close();
    std::error_code ignored;
    if (const fs::path draft = draft_of(file); draft != file) fs::remove(draft, ignored);
  } catch (...) {
    // A draft that stays behind does no harm.
  }
}

}  // namespace unicursal::host
