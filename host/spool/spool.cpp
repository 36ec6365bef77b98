#include "host/spool/spool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/model/read_part.hpp"
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

constexpr std::size_t kept = 5;  ///< Number of prints kept; one with many layers takes some tens of MB.
constexpr int format = 3;        ///< Version of print.json and of the two record files.

fs::path order_file(const fs::path& folder) {
  return folder / "print.json";
}
fs::path journal_file(const fs::path& folder) {
  return folder / "journal";
}
fs::path chunk_file(const fs::path& folder) {
  return folder / "chunks";
}
fs::path untouched_file(const fs::path& folder) {
  return folder / "untouched";
}

/// Lets one program at a time use a folder. The system releases the lock however the program ends.
class Lock {
 public:
  explicit Lock(const fs::path& folder) : descriptor_(::open(folder.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ && ::flock(descriptor_.get(), LOCK_EX | LOCK_NB) == 0) return;
    if (descriptor_ && errno == EWOULDBLOCK) {
      throw SpoolError(folder.string(), "", "is being printed by another program",
                       "wait until it has finished, or stop it first");
    }
    throw SpoolError(folder.string(), "", "cannot be opened", "check that it is there and its permissions");
  }

 private:
  Descriptor descriptor_;
};

/// Returns a name such as "2026-11-22-101500-heart", which sorts by time.
std::string folder_name(const fs::path& job) {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d-%H%M%S", &utc);
  return std::string(text.data()) + "-" + job.stem().string();
}

/// Makes a new folder, also if two prints begin within one second.
fs::path make_folder(const fs::path& root, const std::string& name) {
  std::error_code error;
  fs::create_directories(root, error);
  for (int more = 0; more < 1000 && !error; ++more) {
    const fs::path folder = root / (more == 0 ? name : fmt::format("{}-{}", name, more + 1));
    if (::mkdir(folder.c_str(), 0700) == 0) return folder;
    if (errno != EEXIST) error.assign(errno, std::generic_category());
  }
  throw SpoolError(root.string(), "",
                   "cannot hold a new print" + (error ? " (" + error.message() + ")" : std::string()),
                   "check its permissions and that the disk is not full, or name another with --spool");
}

/// Removes the folder of a print that could not be made.
class Unfinished {
 public:
  explicit Unfinished(fs::path folder) : folder_(std::move(folder)) {}
  ~Unfinished() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  void keep() { folder_.clear(); }

 private:
  fs::path folder_;
};

/// The content of a file goes to the disk; best effort.
void sync_file(const fs::path& file) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor) ::fsync(descriptor.get());
}

std::uint32_t checksum_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw SpoolError(file.string(), "", "cannot be read", "check that it is there and its permissions");
  }
  std::uint32_t sum = 0;
  std::string part(1 << 16, '\0');
  while (stream.read(part.data(), static_cast<std::streamsize>(part.size())), stream.gcount() > 0) {
    sum = crc32(std::string_view(part).substr(0, static_cast<std::size_t>(stream.gcount())), sum);
  }
  return sum;
}

/// While this file exists, no line of a layer was sent. It is removed before the first one, which needs no
/// room on the disk, and it is the only record that cannot be cut back.
void make_untouched(const fs::path& folder) {
  write_whole_file(untouched_file(folder), "", WholeFile::Access::owner_only);
}

/// Refuses a text that JSON cannot hold.
void check_text(const std::string& what, const std::string& text) {
  try {
    static_cast<void>(json(text).dump());
  } catch (const json::exception&) {
    throw SpoolError("", "",
                     what + " has a name that is not UTF-8, so it cannot be written to the print's record",
                     "give it a name in UTF-8, or in plain ASCII");
  }
}

/// Copies the files of a job, each into a folder of its own, since their names may be equal. The copies are
/// on the disk, and readable by their owner only.
class Copies {
 public:
  explicit Copies(fs::path folder) : folder_(std::move(folder)) {}

  /// Returns the copy's name below the folder.
  std::string add(const fs::path& file) {
    ++count_;
    return add_beside(file);
  }
  /// The same, beside the copy that was made last.
  std::string add_beside(const fs::path& file) {
    const fs::path copy = place_for(file.filename());
    std::error_code error;
    fs::copy_file(file, copy, error);
    if (!error) fs::permissions(copy, fs::perms::owner_read | fs::perms::owner_write, error);
    if (error) refuse(file, error.message());
    sync_file(copy);
    return sealed(copy);
  }
  /// Keeps a text that is in no file.
  std::string add_text(const std::string& name, const std::string& text) {
    ++count_;
    const fs::path copy = place_for(name);
    write_whole_file(copy, text, WholeFile::Access::owner_only);
    return sealed(copy);
  }
  /// The checksum of every copy, by its name.
  const json& sums() const { return sums_; }

 private:
  /// Makes the folder.
  fs::path place_for(const fs::path& filename) const {
    check_text("a file of the job", filename.string());
    const fs::path copy = folder_ / std::to_string(count_ - 1) / filename;
    for (const fs::path& folder : {folder_, copy.parent_path()}) {
      if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
        refuse(filename, std::error_code(errno, std::generic_category()).message());
    }
    return copy;
  }
  [[noreturn]] void refuse(const fs::path& file, const std::string& reason) const {
    throw SpoolError(file.string(), "", "cannot be copied to " + folder_.string() + " (" + reason + ")",
                     "check its permissions and that the disk is not full");
  }
  /// Puts the copy on record and returns its name.
  std::string sealed(const fs::path& copy) {
    sync_folder(copy.parent_path());
    sync_folder(folder_);
    const std::string name = copy.lexically_relative(folder_).string();
    sums_[name] = checksum_of(copy);
    return name;
  }

  fs::path folder_;
  int count_ = 0;
  json sums_ = json::object();
};

json copies_of(const Job& job, const fs::path& folder) {
  Copies copies(folder / "job");
  const JobInputs inputs = files_of(job);
  const std::string kept_job =
      job.text.empty() ? copies.add(inputs.job) : copies.add_text("job.toml", job.text);
  json files = {{"job", kept_job}, {"profile", copies.add(inputs.profile)}};
  for (const fs::path& model : inputs.models) {
    files["models"].push_back(copies.add(model));
    for (const fs::path& file : core::companion_files(model)) copies.add_beside(file);
  }
  for (const fs::path& file : inputs.fields) {
    files["fields"].push_back(file.empty() ? "" : copies.add(file));
  }
  files["checksums"] = copies.sums();
  return files;
}

/// The checksum of the rest of a record.
std::uint32_t checksum_in(json record) {
  record.erase("checksum");
  return crc32(record.dump());
}

json read_order(const fs::path& folder) {
  std::ifstream stream(order_file(folder));
  json order = json::parse(stream, nullptr, false);
  const bool other = order.is_object() && order.contains("format") && order["format"] != format;
  if (order.is_object() && order.contains("format") && !other) {
    if (order.value("checksum", json()) == checksum_in(order)) return order;
    throw SpoolError(order_file(folder).string(), "", "is damaged", "clear the bed, and print the job again");
  }
  throw SpoolError(order_file(folder).string(), "",
                   other ? "was written by another version of this program" : "is not the record of a print",
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

constexpr std::uint64_t unreadable = std::numeric_limits<std::uint64_t>::max();

/// The number of a print among those that were begun; 0 for prints of older versions, which had none.
std::uint64_t number_of(const fs::path& folder) {
  try {
    return read_order(folder).at("number").get<std::uint64_t>();
  } catch (const json::exception&) {
    return unreadable;
  } catch (const SpoolError&) {
    std::ifstream stream(order_file(folder));
    const json order = json::parse(stream, nullptr, false);
    return order.is_object() && order.value("format", json()) == format - 1 ? 0 : unreadable;
  }
}

/// The number of the next print.
std::uint64_t next_number(const fs::path& root) {
  std::uint64_t last = 0;
  for (const fs::path& folder : kept_prints(root)) {
    if (const std::uint64_t number = number_of(folder); number != unreadable) last = std::max(last, number);
  }
  return last + 1;
}

/// Runs `work`, and turns an exception of the JSON library into a SpoolError.
template <class Work>
auto of_record(const fs::path& folder, Work work) {
  try {
    return work();
  } catch (const json::exception& error) {
    throw SpoolError(order_file(folder).string(), "", fmt::format("is damaged ({})", error.what()),
                     "start the print again from its job");
  }
}

/// Returns the path of a copy; a damaged record must not lead out of the folder.
fs::path copy_in(const fs::path& folder, const std::string& name) {
  const fs::path relative(name);
  if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end()) {
    throw SpoolError(order_file(folder).string(), "", "names a file outside the print's folder",
                     "start the print again from its job");
  }
  return folder / "job" / relative;
}

/// Removes old prints, except those in use.
void remove_old(const fs::path& root) {
  std::vector<fs::path> prints = kept_prints(root);
  std::erase_if(prints, [](const fs::path& folder) { return number_of(folder) == unreadable; });
  for (std::size_t i = kept; i < prints.size(); ++i) {
    try {
      const Lock lock(prints[i]);
      read_order(prints[i]);  // throws if the folder is not a print, which is then not removed
      std::error_code ignored;
      fs::remove_all(prints[i], ignored);
    } catch (const SpoolError&) {
      // In use, or not ours to remove.
    }
  }
}

/// What was sent was kept before, and what was kept before the last chunk was sent: anything else is damage,
/// with which nobody can say where the printer stands.
void check_chunks(const fs::path& folder, ChunkReader& reader, const SpoolExtent& extent,
                  const JournalState& journal) {
  const auto refuse = [&](const fs::path& file, const std::string& problem) {
    throw SpoolError(
        file.string(), "",
        fmt::format("{}; it is known that {} lines and {} layers had been prepared, and that at least "
                    "{} lines had been sent; nothing was sent to the printer now",
                    problem, extent.lines, extent.layers, std::max(journal.furthest, extent.last_begins)),
        "clear the bed, and print the job again from the beginning");
  };
  if (reader.damaged_within())
    refuse(chunk_file(folder), "is damaged, and more was written behind the damage");
  if (journal.legs == 0) refuse(journal_file(folder), "does not hold the beginning of the print");
  if (journal.furthest > extent.lines) {
    refuse(chunk_file(folder), "ends before the last line that was sent");
  }
  if (journal.furthest < extent.last_begins || (extent.chunks > 0 && !journal.connected)) {
    refuse(journal_file(folder), "ends before the last lines that were sent");
  }
}

/// When the file was changed; now, if nobody knows.
std::chrono::system_clock::time_point time_of(const fs::path& file) {
  std::error_code unknown;
  const auto time = fs::last_write_time(file, unknown);
  if (unknown) return std::chrono::system_clock::now();
  return std::chrono::time_point_cast<std::chrono::system_clock::duration>(
      std::chrono::file_clock::to_sys(time));
}

void check_copies(const fs::path& folder, const json& record) {
  of_record(folder, [&] {
    for (const auto& [name, sum] : record.at("files").at("checksums").items()) {
      const fs::path copy = copy_in(folder, name);
      if (checksum_of(copy) == sum.get<std::uint32_t>()) continue;
      throw SpoolError(copy.string(), "", "is damaged, so the rest of the part would differ",
                       "clear the bed, and print the job again from the beginning");
    }
  });
}

void supersede(const fs::path& folder, const PrintOrder& by, const std::string& name) {
  const Lock lock(folder);
  const json record = read_order(folder);
  const PrintOrder order = of_record(folder, [&] { return order_in(record); });
  if (order.port != by.port && order.device != by.device) return;
  std::uint64_t sound = 0;
  const JournalState state = read_journal(journal_file(folder), &sound);
  const bool over = state.ended && state.ended->outcome == LegOutcome::completed;
  if (!over && !state.superseded) Journal(journal_file(folder), sound).supersede(name);
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
  std::optional<std::chrono::system_clock::time_point> last_written;
  std::unique_ptr<Lock> lock;
};

Spool::Spool(std::unique_ptr<State> state) : state_(std::move(state)) {}
Spool::~Spool() = default;
Spool::Spool(Spool&&) noexcept = default;

Spool Spool::create(const fs::path& root, const Job& job, const PrintOrder& order) {
  check_text("the job", order.job_name);
  check_text("the port", order.port);
  const fs::path folder = make_folder(root, folder_name(job.file));
  Unfinished unfinished(folder);
  auto lock = std::make_unique<Lock>(folder);
  json record = {{"format", format},
                 {"program", UNICURSAL_VERSION},
                 {"number", next_number(root)},
                 {"name", order.job_name},
                 {"port", order.port},
                 {"device", order.device},
                 {"layer_count", order.layer_count},
                 {"layers", order.layers ? json{order.layers->first, order.layers->second} : json()},
                 {"look_ahead", job.print.look_ahead},
                 {"full_quality", job.full_quality},
                 {"allow_bare", job.allow_bare},
                 {"files", copies_of(job, folder)}};
  if (job.sliced) record["sliced"] = {{"tower", job.sliced->tower}, {"stops", job.sliced->allow_stops}};
  record["checksum"] = checksum_in(record);
  auto state = std::make_unique<State>(folder, record, 0, 0);
  state->lock = std::move(lock);
  state->journal.begin_leg({});
  state->journal.sync();
  make_untouched(folder);
  // Last: only now it counts as a print.
  write_whole_file(order_file(folder), record.dump(1) + "\n", WholeFile::Access::owner_only);
  sync_folder(root);
  unfinished.keep();
  remove_old(root);
  return Spool(std::move(state));
}

Spool Spool::open(const fs::path& folder) {
  auto lock = std::make_unique<Lock>(folder);
  json record = read_order(folder);
  const auto last_written = time_of(journal_file(folder));
  std::uint64_t sound_journal = 0;
  JournalState before = read_journal(journal_file(folder), &sound_journal);
  SpoolExtent extent;
  ChunkReader chunks(chunk_file(folder));
  while (const auto chunk = chunks.next()) extent.add(*chunk);
  check_chunks(folder, chunks, extent, before);
  check_copies(folder, record);
  auto state = std::make_unique<State>(folder, std::move(record), chunks.sound(), sound_journal);
  state->extent = extent;
  state->lock = std::move(lock);
  state->before = std::move(before);
  state->last_written = last_written;
  return Spool(std::move(state));
}

void Spool::look_again() {
  state_->journal.sync();
  JournalState before = read_journal(journal_file(state_->folder));
  SpoolExtent extent;
  ChunkReader chunks(chunk_file(state_->folder));
  while (const auto chunk = chunks.next()) extent.add(*chunk);
  check_chunks(state_->folder, chunks, extent, before);
  state_->before = std::move(before);
  state_->extent = extent;
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
std::optional<std::chrono::system_clock::time_point> Spool::last_written() const {
  return state_->last_written;
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
    const std::vector<fs::path*> names = model_names(job);
    if (models.size() != names.size() || fields.size() != job.source.zones.size()) {
      throw SpoolError(order_file(folder).string(), "", "does not match the job beside it",
                       "start the print again from its job");
    }
    job.print.look_ahead = state_->record.at("look_ahead").get<bool>();
    job.full_quality = state_->record.at("full_quality").get<bool>();
    job.allow_bare = state_->record.value("allow_bare", job.allow_bare);
    if (job.sliced) {
      job.sliced->tower = state_->record.at("sliced").at("tower").get<bool>();
      job.sliced->allow_stops = state_->record.at("sliced").at("stops").get<bool>();
    }
    for (std::size_t i = 0; i < models.size(); ++i) *names[i] = copy(models[i]);
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
        supersede(folder, state_->order, state_->folder.filename().string());
      } catch (const SpoolError&) {
        // In use on another printer, or damaged.
      }
    }
  } catch (...) {
    // Out of memory. The checks when one of them is resumed remain.
  }
}

void Spool::discard() noexcept {
  std::error_code ignored;
  fs::remove_all(state_->folder, ignored);
}

bool Spool::untouched() const {
  std::error_code unknown;
  return fs::exists(untouched_file(state_->folder), unknown);
}

void Spool::append(const SpooledChunk& chunk) {
  if (chunk.kind != SpooledChunk::Kind::start && untouched()) {
    std::error_code error;
    if (!fs::remove(untouched_file(state_->folder), error)) {
      throw SpoolFull(state_->folder.string(), "", "cannot be written to (" + error.message() + ")",
                      "check its permissions and the disk");
    }
    sync_folder(state_->folder);
  }
  state_->journal.sync();
  state_->chunks.append(to_bytes(chunk));
  try {
    state_->chunks.sync();
  } catch (const SpoolFull&) {
    state_->chunks.drop_last();  // the caller appends it again when there is room
    throw;
  }
}

fs::path default_spool_root() {
  if (const auto home = state_home()) return *home / "prints";
  throw SpoolError("", "", "there is no home folder in which to keep the print",
                   "name a folder with --spool");
}

std::vector<fs::path> kept_prints(const fs::path& root) {
  std::vector<fs::path> prints;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root, error)) {
    if (fs::exists(order_file(entry.path()), error)) prints.push_back(entry.path());
  }
  std::vector<std::pair<std::uint64_t, fs::path>> numbered;
  for (const fs::path& folder : prints) numbered.emplace_back(number_of(folder), folder);
  std::sort(numbered.rbegin(), numbered.rend());
  std::transform(numbered.begin(), numbered.end(), prints.begin(),
                 [](const auto& one) { return one.second; });
  return prints;
}

LaterPrints later_prints(const Spool& spool, const std::optional<std::string>& port) {
  LaterPrints later;
  const std::uint64_t number = number_of(spool.folder());
  std::error_code unknown;
  const fs::path device = port ? fs::canonical(*port, unknown) : fs::path();
  for (const fs::path& folder : kept_prints(spool.folder().parent_path())) {
    if (number_of(folder) <= number || folder == spool.folder()) continue;
    const std::string name = folder.filename().string();
    try {
      const json record = read_order(folder);
      const PrintOrder order = of_record(folder, [&] { return order_in(record); });
      if (!read_journal(journal_file(folder)).connected) continue;
      const bool same = order.port == spool.order().port || order.device == spool.order().device ||
                        order.port == port || (!device.empty() && order.device == device);
      std::string& kind = same ? later.same : later.other;
      if (kind.empty()) kind = name;
    } catch (const SpoolError&) {
      if (later.other.empty()) later.other = name;
    }
  }
  return later;
}

std::string describe(const fs::path& folder) {
  const json record = read_order(folder);
  const PrintOrder order = of_record(folder, [&] { return order_in(record); });
  const JournalState state = read_journal(journal_file(folder));
  std::string how = "interrupted";
  if (state.ended) {
    constexpr std::array words{"completed", "stopped", "failed"};
    how = words.at(static_cast<std::size_t>(state.ended->outcome));
  }
  return fmt::format("{}, {} layers, {} lines taken: {}", order.job_name, order.layer_count,
                     state.leg.line(state.acknowledged), how);
}

}  // namespace unicursal::host
