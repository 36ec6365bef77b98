#include "host/spool/spool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/files/descriptor.hpp"
#include "host/files/state_home.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/load_job.hpp"
#include "host/spool/bytes.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kept = 5;  ///< prints; a part of many layers takes some tens of MB
constexpr int format = 1;        ///< of print.json and of the two record files

fs::path order_file(const fs::path& folder) {
  return folder / "print.json";
}
fs::path journal_file(const fs::path& folder) {
  return folder / "journal";
}
fs::path chunk_file(const fs::path& folder) {
  return folder / "chunks";
}

/// One program at a time; given back by the system however that program ends.
class Lock {
 public:
  explicit Lock(const fs::path& folder) : descriptor_(::open(folder.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ && ::flock(descriptor_.get(), LOCK_EX | LOCK_NB) == 0) return;
    if (descriptor_ && errno == EWOULDBLOCK) {
      throw SpoolError(folder.string(), "", "is being printed by another program",
                       "wait for its end, or stop it first");
    }
    throw SpoolError(folder.string(), "", "cannot be opened", "check that it is there and its permissions");
  }

 private:
  Descriptor descriptor_;
};

/// "2026-11-22-101500-heart": sorts by time, and says what it is.
std::string folder_name(const fs::path& job) {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d-%H%M%S", &utc);
  return std::string(text.data()) + "-" + job.stem().string();
}

/// A new folder, also when two prints begin within a second.
fs::path make_folder(const fs::path& root, const std::string& name) {
  std::error_code error;
  fs::create_directories(root, error);
  for (int more = 0; more < 1000 && !error; ++more) {
    const fs::path folder = root / (more == 0 ? name : fmt::format("{}-{}", name, more + 1));
    if (fs::create_directory(folder, error)) return folder;
  }
  throw SpoolError(root.string(), "",
                   "cannot hold a new print" + (error ? " (" + error.message() + ")" : std::string()),
                   "check its permissions and that the disk is not full, or name another with --spool");
}

/// Files of a job that may share their names get a folder each.
class Copies {
 public:
  explicit Copies(fs::path folder) : folder_(std::move(folder)) {}

  /// Returns the copy's name below the folder.
  std::string add(const fs::path& file) {
    const fs::path name = fs::path(std::to_string(count_++)) / file.filename();
    std::error_code error;
    fs::create_directories((folder_ / name).parent_path(), error);
    if (!error) fs::copy_file(file, folder_ / name, error);
    if (error) {
      throw SpoolError(file.string(), "",
                       "cannot be copied to " + folder_.string() + " (" + error.message() + ")",
                       "check its permissions and that the disk is not full");
    }
    return name.string();
  }

 private:
  fs::path folder_;
  int count_ = 0;
};

json copies_of(const Job& job, const fs::path& folder) {
  Copies copies(folder / "job");
  const JobInputs inputs = files_of(job);
  json files = {{"job", copies.add(inputs.job)}, {"profile", copies.add(inputs.profile)}};
  for (const fs::path& file : inputs.models) files["models"].push_back(copies.add(file));
  for (const fs::path& file : inputs.fields) {
    files["fields"].push_back(file.empty() ? "" : copies.add(file));
  }
  return files;
}

json read_order(const fs::path& folder) {
  std::ifstream stream(order_file(folder));
  json order = json::parse(stream, nullptr, false);
  if (order.is_object() && order.value("format", json()) == format) return order;
  const bool other = order.is_object() && order.contains("format");
  throw SpoolError(order_file(folder).string(), "",
                   other ? "was written by another version of this program" : "is no record of a print",
                   other ? "resume with that version" : "see `unicursal resume --list`");
}

PrintOrder order_in(const json& record) {
  PrintOrder order;
  order.job_name = record.at("name").get<std::string>();
  order.port = record.at("port").get<std::string>();
  order.device = record.at("device").get<std::string>();
  order.layer_count = record.at("layer_count").get<std::size_t>();
  if (const json& layers = record.at("layers"); layers.is_array()) {
    order.layers = std::pair(layers.at(0).get<std::size_t>(), layers.at(1).get<std::size_t>());
  }
  return order;
}

/// What json throws, as a sentence.
template <class Work>
auto of_record(const fs::path& folder, Work work) {
  try {
    return work();
  } catch (const json::exception& error) {
    throw SpoolError(order_file(folder).string(), "", fmt::format("is damaged ({})", error.what()),
                     "begin the print anew");
  }
}

/// A copy's path; what a damaged record names elsewhere is not followed.
fs::path copy_in(const fs::path& folder, const std::string& name) {
  const fs::path relative(name);
  if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end()) {
    throw SpoolError(order_file(folder).string(), "", "names a file outside of the print's folder",
                     "begin the print anew");
  }
  return folder / "job" / relative;
}

/// Those that are being printed stay, whatever their age.
void remove_old(const fs::path& root) {
  const std::vector<fs::path> prints = kept_prints(root);
  for (std::size_t i = kept; i < prints.size(); ++i) {
    try {
      const Lock lock(prints[i]);
      read_order(prints[i]);  // nothing is removed that is no print
      std::error_code ignored;
      fs::remove_all(prints[i], ignored);
    } catch (const SpoolError&) {
      // In use, or not ours to remove.
    }
  }
}

void supersede(const fs::path& folder, const PrintOrder& by) {
  const Lock lock(folder);
  const json record = read_order(folder);
  const PrintOrder order = of_record(folder, [&] { return order_in(record); });
  if (order.port != by.port && order.device != by.device) return;
  std::uint64_t sound = 0;
  const JournalState state = read_journal(journal_file(folder), &sound);
  const bool over = state.ended && state.ended->outcome == Outcome::completed;
  if (!over && !state.superseded) Journal(journal_file(folder), sound).supersede();
}

}  // namespace

struct Spool::State {
  State(fs::path in, json what, std::uint64_t sound_chunks, std::uint64_t sound_journal)
      : folder(std::move(in)),
        record(std::move(what)),
        order(of_record(folder, [&] { return order_in(record); })),
        chunks(chunk_file(folder), sound_chunks),
        journal(journal_file(folder), sound_journal) {}

  fs::path folder;
  json record;
  PrintOrder order;
  RecordWriter chunks;
  Journal journal;
  JournalState before;
  SpoolExtent extent;
  std::unique_ptr<Lock> lock;
};

Spool::Spool(std::unique_ptr<State> state) : state_(std::move(state)) {}
Spool::~Spool() = default;
Spool::Spool(Spool&&) noexcept = default;

Spool Spool::create(const fs::path& root, const Job& job, const PrintOrder& order) {
  const fs::path folder = make_folder(root, folder_name(job.file));
  auto lock = std::make_unique<Lock>(folder);
  json record = {{"format", format},
                 {"program", UNICURSAL_VERSION},
                 {"name", order.job_name},
                 {"port", order.port},
                 {"device", order.device},
                 {"layer_count", order.layer_count},
                 {"layers", order.layers ? json{order.layers->first, order.layers->second} : json()},
                 {"look_ahead", job.print.look_ahead},
                 {"full_quality", job.full_quality},
                 {"files", copies_of(job, folder)}};
  auto state = std::make_unique<State>(folder, record, 0, 0);
  state->lock = std::move(lock);
  state->journal.begin_leg({});
  // Last: only now it counts as a print.
  write_whole_file(order_file(folder), record.dump(1) + "\n");
  sync_folder(root);
  remove_old(root);
  return Spool(std::move(state));
}

Spool Spool::open(const fs::path& folder) {
  auto lock = std::make_unique<Lock>(folder);
  json record = read_order(folder);
  std::uint64_t sound_journal = 0;
  JournalState before = read_journal(journal_file(folder), &sound_journal);
  SpoolExtent extent;
  ChunkReader chunks(chunk_file(folder));
  while (const auto chunk = chunks.next()) extent.add(*chunk);
  auto state = std::make_unique<State>(folder, std::move(record), chunks.sound(), sound_journal);
  state->extent = extent;
  state->lock = std::move(lock);
  state->before = std::move(before);
  return Spool(std::move(state));
}

const fs::path& Spool::folder() const {
  return state_->folder;
}
const PrintOrder& Spool::order() const {
  return state_->order;
}
fs::path Spool::chunks() const {
  return chunk_file(state_->folder);
}
Journal& Spool::journal() {
  return state_->journal;
}
const JournalState& Spool::before() const {
  return state_->before;
}

const SpoolExtent& Spool::extent() const {
  return state_->extent;
}

Job Spool::job() const {
  const fs::path& folder = state_->folder;
  return of_record(folder, [&] {
    const json& files = state_->record.at("files");
    const auto copy = [&](const json& name) { return copy_in(folder, name.get<std::string>()); };
    Job job = load_job(copy(files.at("job")), copy(files.at("profile")));
    const json fields = files.value("fields", json::array()), models = files.at("models");
    if (models.size() != job.source.files.size() || fields.size() != job.source.zones.size()) {
      throw SpoolError(order_file(folder).string(), "", "does not go with the job beside it",
                       "begin the print anew");
    }
    job.print.look_ahead = state_->record.at("look_ahead").get<bool>();
    job.full_quality = state_->record.at("full_quality").get<bool>();
    for (std::size_t i = 0; i < models.size(); ++i) job.source.files[i] = copy(models[i]);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i] != "") job.source.zones[i].pattern.field = copy(fields[i]);
    }
    return job;
  });
}

void Spool::supersede_others() noexcept {
  try {
    for (const fs::path& folder : kept_prints(state_->folder.parent_path())) {
      if (folder == state_->folder) continue;
      try {
        supersede(folder, state_->order);
      } catch (const SpoolError&) {
        // In use on another printer, or beyond help.
      }
    }
  } catch (...) {
    // No memory for that; the checks when one of them is resumed remain.
  }
}

void Spool::discard() noexcept {
  std::error_code ignored;
  fs::remove_all(state_->folder, ignored);
}

void Spool::append(const SpooledChunk& chunk) {
  state_->chunks.append(to_bytes(chunk));
  try {
    state_->chunks.sync();
  } catch (const SpoolFull&) {
    state_->chunks.drop_last();  // it is appended again when there is room
    throw;
  }
}

fs::path default_spool_root() {
  if (const auto home = state_home()) return *home / "prints";
  throw SpoolError("", "", "there is no home folder to keep the print in", "name a folder with --spool");
}

std::vector<fs::path> kept_prints(const fs::path& root) {
  std::vector<fs::path> prints;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root, error)) {
    if (fs::exists(order_file(entry.path()), error)) prints.push_back(entry.path());
  }
  std::sort(prints.rbegin(), prints.rend());
  return prints;
}

std::string describe(const fs::path& folder) {
  const json record = read_order(folder);
  const PrintOrder order = of_record(folder, [&] { return order_in(record); });
  const JournalState state = read_journal(journal_file(folder));
  std::string how = "interrupted";
  if (state.ended) {
    constexpr std::array words{"completed", "stopped by the user", "failed"};
    how = words.at(static_cast<std::size_t>(state.ended->outcome));
  }
  return fmt::format("{}, {} layers, {} lines taken: {}", order.job_name, order.layer_count,
                     state.leg.line(state.acknowledged), how);
}

}  // namespace unicursal::host
