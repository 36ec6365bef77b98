#include "host/files/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

bool is_device_or_pipe(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

/// The file behind symbolic links, also when it does not exist yet.
fs::path end_of_links(const fs::path& file) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(file, error))) return file;
  if (const fs::path whole = fs::canonical(file, error); !error) return whole;
  const fs::path next = fs::read_symlink(file, error);
  return error ? file : file.parent_path() / next;
}

mode_t mode_for(WholeFile::Access access) {
  return access == WholeFile::Access::owner_only ? 0600 : 0666;  // less the umask
}

}  // namespace

WholeFile::WholeFile(fs::path file, Access access) : file_(std::move(file)) {
  std::error_code error;
  if (fs::is_directory(file_, error)) {
    throw core::FileError(file_.string(), "", "is a folder", "name a file");
  }
  if (file_.has_parent_path()) fs::create_directories(file_.parent_path(), error);
  const bool direct = is_device_or_pipe(file_);
  target_ = direct || access == Access::owner_only ? file_ : end_of_links(file_);
  draft_ = target_;
  if (!direct) {
    draft_ += ".part";
    fs::remove(draft_, error);
    const int flags = O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW;
    descriptor_.reset(::open(draft_.c_str(), flags, mode_for(access)));
    struct stat before {};
    if (descriptor_ && access == Access::as_before && ::stat(target_.c_str(), &before) == 0) {
      ::fchmod(descriptor_.get(), before.st_mode & 07777);
    }
  }
  if (direct || descriptor_) stream_.open(draft_, std::ios::binary | std::ios::trunc);
  if (!stream_.is_open()) {
    discard();
    throw core::FileError(file_.string(), "", "cannot be written", "check the folder and its permissions");
  }
}

WholeFile::~WholeFile() {
  if (stream_.is_open()) discard();
}

void WholeFile::publish() {
  stream_.close();
  bool written = !stream_.fail();
  if (descriptor_) {
    written = written && ::fsync(descriptor_.get()) == 0 && ::rename(draft_.c_str(), target_.c_str()) == 0;
  }
  if (!written) {
    discard();
    throw core::FileError(file_.string(), "", "could not be written to its end",
                          "check that the disk is not full");
  }
  if (descriptor_) sync_folder(target_.has_parent_path() ? target_.parent_path() : ".");
}

void WholeFile::discard() noexcept {
  stream_.close();
  std::error_code ignored;
  if (descriptor_) fs::remove(draft_, ignored);
  descriptor_.reset();
}

void write_whole_file(const fs::path& file, std::string_view content, WholeFile::Access access) {
  WholeFile whole(file, access);
  whole.stream() << content;
  whole.publish();
}

void sync_folder(const fs::path& folder) noexcept {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor) ::fsync(descriptor.get());
}

}  // namespace unicursal::host
