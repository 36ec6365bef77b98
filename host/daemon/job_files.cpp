#include "host/daemon/job_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/model/file_kind.hpp"
#include "core/text/printable.hpp"
#include "host/daemon/plain_name.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/daemon/upload_kind.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/job_error.hpp"
#include "host/job/parse_toml.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view upload_prefix = "upload:";
constexpr std::size_t longest_job_name = 512;
constexpr int deepest_folder = 4;
constexpr std::uintmax_t largest_job = 1024 * 1024;  ///< bytes of a job's own text

Refused no_such(const std::string& name) {
  return {Why::not_found, "there is no job \"" + core::printable(name) + "\"; see `unicursal queue --jobs`"};
}

/// Whether `path` is below `folder`; both canonical.
bool within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Accepts relative names without "..". Links are checked elsewhere.
void check_name(const std::string& name) {
  const fs::path path(name);
  bool sound = !name.empty() && name.size() <= longest_job_name && path.is_relative() && is_queueable(path);
  sound = sound && name.find('\0') == std::string::npos && name.find('\\') == std::string::npos;
  for (const fs::path& part : path) sound = sound && part != ".." && part != "." && !part.empty();
  if (!sound)
    throw Refused(Why::bad_name,
                  "a job is named by its file in one of the daemon's folders, such as leaf.toml or leaf.svg");
}

void check_texts(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    if (text->get().find_first_of("/\\") != std::string::npos || text->get() == "..")
      throw Refused(Why::bad_job, "the texts of an uploaded job may not contain a slash: \"" +
                                      core::printable(text->get()) +
                                      "\"; upload the file and give its name alone");
  } else if (const auto* list = node.as_array()) {
    for (const toml::node& item : *list) check_texts(item);
  } else if (const auto* table = node.as_table()) {
    for (const auto& entry : *table) check_texts(entry.second);
  }
}

void check_uploaded_job(const fs::path& file) {
  std::error_code error;
  if (fs::file_size(file, error) > largest_job || error)
    throw Refused(Why::bad_job, "the job's text is too long to be one; keep models in files of their own");
  try {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    check_texts(parse_toml(text.str(), file.filename()));
  } catch (const JobError& wrong) {
    throw Refused(Why::bad_job, wrong.what());
  }
}

/// Profiles lie beside their jobs. A job names its printer; only a profile has a table of that name, and it
/// stands near the beginning.
bool is_profile(const fs::path& path) {
  constexpr std::size_t most_bytes = 64 * 1024;
  if (path.extension() != ".toml") return false;
  std::string text(most_bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text.starts_with("[printer]") || text.find("\n[printer]") != std::string::npos;
}

/// Adds the jobs in `folder` by the names that find() takes. Links to folders are not followed, and links to
/// files must stay within the folder.
void add_jobs(const fs::path& folder, const std::string& prefix, std::vector<std::string>& names) {
  std::error_code error;
  for (fs::recursive_directory_iterator item(folder, fs::directory_options::skip_permission_denied, error),
       end;
       !error && item != end && names.size() < most_listed_jobs; item.increment(error)) {
    if (item.depth() >= deepest_folder) item.disable_recursion_pending();
    std::error_code gone;
    if (is_queueable(item->path()) && item->is_regular_file(gone) &&
        within(fs::canonical(item->path(), gone), folder) && !is_profile(item->path()))
      names.push_back(prefix + item->path().lexically_relative(folder).generic_string());
  }
}

/// Whether a folder is missing or empty, or holds one file of this name.
bool holds_only(const fs::path& folder, const std::string& file) {
  std::error_code error;
  for (fs::directory_iterator item(folder, error), end; !error && item != end; item.increment(error)) {
    if (item->path().filename() != file) return false;
  }
  return !error || error == std::errc::no_such_file_or_directory;
}

}  // namespace

JobFiles::JobFiles(std::vector<fs::path> folders, fs::path uploads)
    : folders_(std::move(folders)), uploads_(std::move(uploads)) {
  UploadDraft::remove_old(uploads_);
  for (fs::path& folder : folders_) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (error || !fs::is_directory(real, error)) {
      throw DaemonError(folder.string(), "", "is not a folder that can be read",
                        "name the folders of the jobs with --jobs");
    }
    folder = real;
  }
}

bool JobFiles::is_upload(const std::string& name) {
  return name.starts_with(upload_prefix);
}

std::string JobFiles::upload_of(const std::string& job) {
  return job.substr(upload_prefix.size(), job.find('/') - upload_prefix.size());
}

bool JobFiles::is_from(const std::string& name, const std::string& upload) {
  return name.starts_with(std::string(upload_prefix) + upload + "/");
}

fs::path JobFiles::find_upload(const std::string& name) const {
  const std::string inside = name.substr(upload_prefix.size());
  const std::size_t slash = inside.find('/');
  const std::string upload = inside.substr(0, slash);
  const std::string file = slash == std::string::npos ? "" : inside.substr(slash + 1);
  if (!is_plain_name(upload) || !is_plain_name(file) || !is_queueable(file))
    throw Refused(Why::bad_name,
                  "an uploaded job is named as in upload:leaf/job.toml or upload:leaf/leaf.3mf");
  const fs::path path = uploads_ / upload / file;
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error))) throw no_such(name);
  if (path.extension() == ".toml") check_uploaded_job(path);
  return path;
}

fs::path JobFiles::find(const std::string& name) const {
  if (is_upload(name)) return find_upload(name);
  check_name(name);
  for (const fs::path& folder : folders_) {
    std::error_code error;
    const fs::path real = fs::canonical(folder / name, error);
    if (error || !within(real, folder) || !fs::is_regular_file(real, error)) continue;
    return real;
  }
  throw no_such(name);
}

std::string JobFiles::name_of(const fs::path& file) const {
  std::error_code error;
  const fs::path real = fs::canonical(file, error);
  if (error) return {};
  for (const fs::path& folder : folders_) {
    if (within(real, folder)) return real.lexically_relative(folder).generic_string();
  }
  return {};
}

std::vector<std::string> JobFiles::list() const {
  std::vector<std::string> names;
  for (const fs::path& folder : folders_) add_jobs(folder, "", names);
  std::error_code error;
  add_jobs(fs::canonical(uploads_, error), std::string(upload_prefix), names);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void JobFiles::keep(const std::string& upload, const std::string& file, const std::string& bytes) const {
  if (!is_plain_name(upload) || !is_plain_name(file))
    throw Refused(Why::bad_name, "names of uploads hold letters, digits, dots, dashes and underscores only");
  if (fs::path(file).extension() == ".part")  // a draft of another upload has such a name (whole_file.hpp)
    throw Refused(Why::bad_name, "a name that ends in .part is that of an unfinished file; choose another");
  check_room(bytes.size());
  std::error_code error;
  fs::create_directories(uploads_ / upload, error);
  try {
    write_whole_file(uploads_ / upload / file, bytes, WholeFile::Access::owner_only);
  } catch (const core::FileError& full) {
    throw Refused(Why::no_room, full.what());
  }
}

void JobFiles::check_room(std::uint64_t bytes) const {
  std::uint64_t kept = bytes;
  std::size_t files = 1;
  std::error_code error;
  for (fs::recursive_directory_iterator item(uploads_, error), end; !error && item != end;
       item.increment(error)) {
    std::error_code gone;
    if (!item->is_regular_file(gone)) continue;
    kept += item->file_size(gone);
    ++files;
  }
  if (kept > most_uploaded || files > most_uploaded_files)
    throw Refused(Why::no_room, "uploads_full", "no room is left for more uploads; remove some first");
  if (bytes + left_on_disk > free_bytes())
    throw Refused(Why::no_room, "disk_full",
                  "the daemon's disk is almost full; make room and send the file again");
}

std::uint64_t JobFiles::free_bytes() const {
  std::error_code error;
  const fs::space_info space = fs::space(uploads_.parent_path(), error);
  return error ? 0 : space.available;
}

std::unique_ptr<UploadDraft> JobFiles::draft(std::uint64_t bytes) const {
  check_room(bytes);
  return std::make_unique<UploadDraft>(uploads_);
}

std::string JobFiles::adopt(UploadDraft& draft, const std::string& file,
                            const std::function<bool(const std::string&)>& needed) const {
  const fs::path name(file);
  for (std::size_t i = 1; i <= most_uploaded_files; ++i) {
    const std::string upload = name.stem().string() + (i == 1 ? "" : "-" + std::to_string(i));
    const std::string kept = upload + name.extension().string();
    const fs::path folder = uploads_ / upload;
    if (needed(upload) || !holds_only(folder, kept)) continue;
    std::error_code error;
    fs::create_directory(folder, error);
    try {
      draft.publish(folder / kept);
    } catch (...) {
      fs::remove(folder, error);  // if it is empty
      throw;
    }
    return std::string(upload_prefix).append(upload).append("/").append(kept);
  }
  throw Refused(Why::no_room, "uploads_full", "too many uploads have that name; remove some first");
}

std::optional<std::string> local_name(const std::string& job) {
  if (!JobFiles::is_upload(job)) {
    // Addresses hold no per cent signs here (http_message.hpp).
    const bool sound = std::all_of(job.begin(), job.end(), [](char c) {
      return c > ' ' && c < '\x7f' && std::string_view("%?#\"<>\\").find(c) == std::string_view::npos;
    });
    return sound ? std::optional(job) : std::nullopt;
  }
  const fs::path inside(job.substr(upload_prefix.size()));
  if (inside.parent_path() != inside.stem()) return std::nullopt;
  return inside.filename().string();
}

LocalFile JobFiles::local_file(const std::string& name) const {
  std::string job = name;
  if (is_plain_name(name)) {
    const std::string upload = std::string(upload_prefix) + fs::path(name).stem().string() + "/" + name;
    std::error_code error;
    if (fs::exists(uploads_ / upload.substr(upload_prefix.size()), error)) job = upload;
  }
  if (is_upload(name)) throw no_such(name);
  const fs::path file = find(job);
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) throw no_such(name);
  return {name, job, static_cast<std::uint64_t>(found.st_size), found.st_mtime};
}

std::vector<LocalFile> JobFiles::local_files() const {
  std::vector<LocalFile> files;
  for (const std::string& job : list()) {
    const auto name = local_name(job);
    if (!name) continue;
    try {
      files.push_back(local_file(*name));
    } catch (const Refused&) {
      // It has just been removed, or its text cannot be that of an uploaded job.
    }
  }
  const auto by_name = [](const LocalFile& a, const LocalFile& b) { return a.name < b.name; };
  std::sort(files.begin(), files.end(), by_name);
  const auto same = [](const LocalFile& a, const LocalFile& b) { return a.name == b.name; };
  files.erase(std::unique(files.begin(), files.end(), same), files.end());
  return files;
}

void JobFiles::remove(const std::string& upload) const {
  if (!is_plain_name(upload)) throw Refused(Why::bad_name, "that is not a name of an upload");
  std::error_code error;
  if (fs::remove_all(uploads_ / upload, error) == 0 || error)
    throw Refused(Why::not_found, "there is no upload \"" + upload + "\"");
}

}  // namespace unicursal::host
