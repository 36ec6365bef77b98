#include "host/daemon/upload_draft.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "host/daemon/refused.hpp"
#include "host/files/whole_file.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view draft_prefix = ".draft-";

Refused full() {
  const int number = errno;
  return {Refused::Why::no_room, std::string("the file cannot be kept (") + std::strerror(number) +
                                     "); make room on the daemon's disk and send it again"};
}

}  // namespace

UploadDraft::UploadDraft(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  std::string name = (folder / (std::string(draft_prefix) + "XXXXXX")).string();
  descriptor_.reset(::mkostemp(name.data(), O_CLOEXEC));  // 0600
  if (!descriptor_) throw full();
  draft_ = name;
}

UploadDraft::~UploadDraft() {
  if (!draft_.empty()) ::unlink(draft_.c_str());
}

void UploadDraft::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw full();
    size_ += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void UploadDraft::publish(const fs::path& file) {
  if (::fsync(descriptor_.get()) != 0 || ::rename(draft_.c_str(), file.c_str()) != 0) throw full();
  draft_.clear();
  descriptor_.reset();
  sync_folder(file.parent_path());
}

void UploadDraft::remove_old(const fs::path& folder) noexcept {
  std::error_code error;
  for (fs::directory_iterator item(folder, error), end; !error && item != end; item.increment(error)) {
    std::error_code ignored;
    if (item->path().filename().string().starts_with(draft_prefix)) fs::remove(item->path(), ignored);
  }
}

}  // namespace unicursal::host
