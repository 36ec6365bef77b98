// How a daemon keeps the files that are sent to it.
#include <fmt/format.h>

#include "host/daemon/daemon.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/refused.hpp"

namespace unicursal::host {
/// Files of a job that waits or is being printed must not change.
void Daemon::check_not_needed(const std::string& upload) const {
  for (const std::string& name : *being_added_) {
    if (JobFiles::is_from(name, upload))
      throw Refused(Why::conflict, "a job from there is being queued; choose another name");
  }
  for (const QueuedJob& job : queue_.jobs()) {
    const bool current = current_ && current_->id == job.id;
    if ((current || job.state == QueuedJob::State::queued) && JobFiles::is_from(job.name, upload))
      throw Refused(Why::conflict, fmt::format("job {} is from there, and {}; choose another name", job.id,
                                               current ? "is being printed" : "waits"));
  }
}

asio::awaitable<void> Daemon::keep_upload(std::string upload, std::string file, std::string bytes) {
  check_not_needed(upload);
  const auto keep = [this, upload, file, bytes = std::move(bytes)] {
    files_.keep(upload, file, bytes);
    return true;
  };
  co_await elsewhere(disk_, keep);
}

asio::awaitable<void> Daemon::remove_upload(std::string upload) {
  check_not_needed(upload);
  const auto remove = [this, upload] {
    files_.remove(upload);
    return true;
  };
  co_await elsewhere(disk_, remove);
}

asio::awaitable<std::vector<std::string>> Daemon::job_names() {
  const auto list = [this] { return files_.list(); };
  co_return co_await elsewhere(disk_, list);
}

/// The folders of those that must not change.
std::set<std::string> Daemon::needed_uploads() const {
  std::set<std::string> needed;
  for (const std::string& name : *being_added_) {
    if (JobFiles::is_upload(name)) needed.insert(JobFiles::upload_of(name));
  }
  for (const QueuedJob& job : queue_.jobs()) {
    const bool current = current_ && current_->id == job.id;
    if ((current || job.state == QueuedJob::State::queued) && JobFiles::is_upload(job.name))
      needed.insert(JobFiles::upload_of(job.name));
  }
  return needed;
}

asio::awaitable<std::shared_ptr<UploadDraft>> Daemon::draft_upload(std::uint64_t bytes) {
  const auto make = [this, bytes] { return std::shared_ptr<UploadDraft>(files_.draft(bytes)); };
  co_return co_await elsewhere(disk_, make);
}

asio::awaitable<void> Daemon::write_upload(std::shared_ptr<UploadDraft> draft, std::string bytes) {
  const auto write = [draft, bytes = std::move(bytes)] {
    draft->write(bytes);
    return true;
  };
  co_await elsewhere(disk_, write);
}

asio::awaitable<std::string> Daemon::adopt_upload(std::shared_ptr<UploadDraft> draft, std::string file) {
  const auto adopt = [this, draft, file, needed = needed_uploads()] {
    return files_.adopt(*draft, file, [&needed](const std::string& one) { return needed.contains(one); });
  };
  co_return co_await elsewhere(disk_, adopt);
}

asio::awaitable<std::vector<LocalFile>> Daemon::local_files() {
  const auto list = [this] { return files_.local_files(); };
  co_return co_await elsewhere(disk_, list);
}

asio::awaitable<LocalFile> Daemon::local_file(std::string name) {
  const auto find = [this, name] { return files_.local_file(name); };
  co_return co_await elsewhere(disk_, find);
}

}  // namespace unicursal::host
