#include "host/daemon/dry_runs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <asio/buffer.hpp>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/post.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/use_awaitable.hpp>
#include <charconv>
#include <fstream>
#include <utility>

#include "host/daemon/elsewhere.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/plain_name.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/daemon/trying_process.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

constexpr const char* run_name = "run.json";
constexpr std::size_t longest_line = 64 * 1024;                 ///< bytes that are taken from a child
constexpr std::size_t longest_reason = 2000;                    ///< bytes
constexpr off_t largest_shown = 64 * 1024 * 1024;               ///< bytes of a file
constexpr std::uintmax_t free_at_least = 512ull * 1024 * 1024;  ///< bytes of the disk, to begin one
constexpr auto between_events = 1s;
constexpr auto for_its_end = 5s;  ///< time that a child has to clear up behind it

std::optional<std::uint64_t> number_of(const std::string& name) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size() || std::to_string(number) != name)
    return std::nullopt;
  return number;
}

bool is_shown(const std::string& name) {
  if (!is_plain_name(name) || name == run_name) return false;
  return std::any_of(shown_files.begin(), shown_files.end(),
                     [&](const auto& kind) { return name.ends_with(kind.first); });
}

Refused no_such_run() {
  return {Why::not_found, "no dry run has that number"};
}
Refused no_such_file() {
  return {Why::not_found, "this dry run has no such file"};
}

/// A plain file, whose name no link has been put in the place of.
std::string bytes_of(const fs::path& file) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat found {};
  if (!descriptor || ::fstat(descriptor.get(), &found) != 0 || !S_ISREG(found.st_mode) ||
      found.st_size > largest_shown)
    throw no_such_file();
  std::string bytes(static_cast<std::size_t>(found.st_size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(descriptor.get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw no_such_file();
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

/// What clients see of a report at once. A report that ended early lacks some of it.
json figures_in(const json& report) {
  json figures = json::object();
  const auto take = [&](const char* key, const json::json_pointer& from, double scale) {
    if (report.contains(from) && report.at(from).is_number())
      figures[key] = report.at(from).get<double>() * scale;
  };
  take("seconds", "/simulator/printer_seconds"_json_pointer, 1);
  take("gaps_percent", "/laid/total/gap_fraction"_json_pointer, 100);
  take("wrong_percent", "/laid/total/mixture/wrong_fraction"_json_pointer, 100);
  for (const auto& [key, from] : {std::pair{"filaments", "/filament/feeders"_json_pointer},
                                  std::pair{"grades", "/grades"_json_pointer}}) {
    if (report.contains(from)) figures[key] = report.at(from);
  }
  return figures;
}

json read_json_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return json::parse(stream, nullptr, false);
}

const char* state_name(DryRunRecord::State state) {
  switch (state) {
    case DryRunRecord::State::running:
      return "running";
    case DryRunRecord::State::done:
      return "done";
    case DryRunRecord::State::failed:
      return "failed";
  }
  return "";
}

std::string text_of_run(const DryRunRecord& run) {
  return to_json(run).dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

void remove_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

/// Throws Refused.
void check_room(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const auto space = fs::space(folder, error);
  if (!error && space.available < free_at_least)
    throw Refused(Why::no_room, "disk_full",
                  "the disk has no room for the pictures of a dry run; delete something first");
}

/// A number is never given twice, or a browser would show an older run's pictures.
std::uint64_t next_id(const fs::path& folder, std::uint64_t least) {
  const auto line = read_line(folder / "next");
  return std::max(least, line ? number_of(*line).value_or(0) : 0);
}

/// Of a file that this program has written.
std::optional<DryRunRecord> run_in(const fs::path& folder, std::uint64_t id) {
  const json kept = read_json_file(folder / run_name);
  if (!kept.is_object() || !kept.value("job", json()).is_string()) return std::nullopt;
  DryRunRecord run;
  run.id = id;
  run.job = kept["job"];
  run.made = kept.value("made", std::int64_t(0));
  run.percent = kept.value("percent", 0.0);
  run.reason = kept.value("reason", std::string());
  run.state = kept.value("state", "") == state_name(DryRunRecord::State::done) ? DryRunRecord::State::done
                                                                               : DryRunRecord::State::failed;
  if (kept.value("state", "") == state_name(DryRunRecord::State::running))
    run.reason = "the daemon ended before the dry run did; begin it again";
  if (const auto layers = kept.find("layers");
      layers != kept.end() && layers->is_array() && layers->size() == 2)
    run.layers = LayerRange{layers->at(0).get<std::size_t>(), layers->at(1).get<std::size_t>()};
  for (const char* key : {"seconds", "filaments", "gaps_percent", "wrong_percent", "grades"}) {
    if (const auto found = kept.find(key); found != kept.end()) run.figures[key] = *found;
  }
  return run;
}

}  // namespace

json to_json(const DryRunRecord& run) {
  json all = {{"id", run.id},
              {"job", run.job},
              {"state", state_name(run.state)},
              {"percent", run.percent},
              {"made", run.made}};
  if (run.layers) all["layers"] = {run.layers->first, run.layers->last};
  if (!run.reason.empty()) all["reason"] = run.reason;
  if (run.figures.is_object()) all.update(run.figures);
  return all;
}

DryRuns::DryRuns(asio::io_context& loop, fs::path folder, std::function<void(const json& event)> changed)
    : loop_(loop), folder_(std::move(folder)), changed_(std::move(changed)) {
  find_older();
}

DryRuns::~DryRuns() {
  process_.reset();
  disk_.join();
}

void DryRuns::find_older() {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    const auto id = number_of(entry.path().filename().string());
    if (!id) continue;
    try {
      if (auto run = run_in(entry.path(), *id)) runs_.push_back(std::move(*run));
    } catch (const json::exception&) {
      // Somebody has changed the file: the run is not shown.
    }
  }
  std::sort(runs_.begin(), runs_.end(),
            [](const DryRunRecord& a, const DryRunRecord& b) { return a.id < b.id; });
}

const DryRunRecord* DryRuns::find(std::uint64_t id) const {
  return const_cast<DryRuns*>(this)->found(id);
}

DryRunRecord* DryRuns::found(std::uint64_t id) {
  const auto here =
      std::find_if(runs_.begin(), runs_.end(), [id](const DryRunRecord& run) { return run.id == id; });
  return here == runs_.end() ? nullptr : &*here;
}

/// Leaves room for one more. Returns the folders of those that are to go.
std::vector<fs::path> DryRuns::forget_oldest() {
  std::vector<fs::path> gone;
  while (runs_.size() >= most_kept) {
    gone.push_back(folder_of(runs_.front().id));
    changed_({{"event", "task"}, {"removed", runs_.front().id}});
    runs_.erase(runs_.begin());
  }
  return gone;
}

/// Of a new run, whose number is returned; the next daemon finds it there. Throws Refused.
asio::awaitable<std::uint64_t> DryRuns::make_folder(DryRunRecord run) {
  const std::uint64_t least = runs_.empty() ? 1 : runs_.back().id + 1;
  const auto make = [folder = folder_, gone = forget_oldest(), least, run]() mutable {
    for (const fs::path& old : gone) remove_folder(old);
    check_room(folder);
    run.id = next_id(folder, least);
    const fs::path made = folder / std::to_string(run.id);
    try {
      fs::create_directories(made);
      write_state(folder / "next", std::to_string(run.id + 1) + "\n");
      write_state(made / run_name, text_of_run(run));
    } catch (const std::exception& error) {
      remove_folder(made);
      throw Refused(Why::no_room, error.what());
    }
    return run.id;
  };
  co_return co_await elsewhere(disk_, make);
}

void DryRuns::announce(const DryRunRecord& run) {
  announced_ = std::chrono::steady_clock::now();
  changed_({{"event", "task"}, {"dry_run", to_json(run)}});
}

/// Best effort: what cannot be written is not found by the next daemon.
void DryRuns::note(const DryRunRecord& run) {
  asio::post(disk_, [id = run.id, file = folder_of(run.id) / run_name, text = text_of_run(run)] {
    try {
      write_state(file, text);
    } catch (const std::exception& error) {
      log_line(fmt::format("dry run {}: {}", id, error.what()));
    }
  });
}

asio::awaitable<std::uint64_t> DryRuns::begin(Wish wish) {
  if (running())
    throw Refused(Why::conflict, "dry_run_going_on",
                  "another dry run is going on; wait for its end, or remove it");
  *beginning_ = true;
  const std::shared_ptr<void> begun(nullptr, [flag = beginning_](void*) { *flag = false; });
  DryRunRecord run;
  run.job = wish.job;
  run.layers = wish.layers;
  run.made =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  run.id = co_await make_folder(run);
  const fs::path folder = folder_of(run.id);
  std::vector<std::string> words{"unicursal", "dry-run",      fs::absolute(wish.file).string(),
                                 "--json",    "--report",     (folder / "report.json").string(),
                                 "--picture", folder.string()};
  if (wish.profile) words.insert(words.end(), {"--profile", wish.profile->string()});
  if (wish.layers)
    words.insert(words.end(), {"--layers", fmt::format("{}:{}", wish.layers->first, wish.layers->last)});
  try {
    process_ = std::make_shared<TryingProcess>(std::move(words));
  } catch (const std::exception& error) {
    asio::post(disk_, [folder] { remove_folder(folder); });
    throw Refused(Why::no_room, error.what());
  }
  log_line(fmt::format("dry run {} {}: begins", run.id, run.job));
  runs_.push_back(run);
  announce(run);
  asio::co_spawn(loop_, follow(run.id, process_), asio::detached);
  co_return run.id;
}

/// Reads what the child says, line by line, until it ends.
asio::awaitable<void> DryRuns::follow(std::uint64_t id, std::shared_ptr<TryingProcess> process) {
  asio::posix::stream_descriptor output(loop_, process->release_output());
  std::array<char, 16 * 1024> bytes{};
  std::string line, reason;
  for (;;) {
    asio::error_code ended;
    const std::size_t count = co_await output.async_read_some(
        asio::buffer(bytes), asio::redirect_error(asio::use_awaitable, ended));
    if (ended) break;
    for (std::size_t i = 0; i < count; ++i) {
      if (bytes[i] == '\n') {
        hear(id, line, reason);
        line.clear();
      } else if (line.size() < longest_line) {
        line += bytes[i];
      }
    }
  }
  const int status = process->wait();
  process_.reset();
  if (!process->ended()) co_await conclude(id, status, std::move(reason));
}

void DryRuns::hear(std::uint64_t id, const std::string& line, std::string& reason) {
  DryRunRecord* const run = found(id);
  if (!run || line.empty()) return;
  if (line.front() != '{') {
    constexpr std::string_view mark = "unicursal: ";
    reason = line.substr(line.starts_with(mark) ? mark.size() : 0, longest_reason);
    return;
  }
  if (line.find("\"progress\"") == std::string::npos) return;
  const json event = json::parse(line, nullptr, false);
  if (!event.is_object() || !event.contains("status") || !event["status"].is_object()) return;
  const json percent = event["status"].value("percent", json());
  if (!percent.is_number()) return;
  run->percent = percent;
  if (std::chrono::steady_clock::now() - announced_ >= between_events) announce(*run);
}

asio::awaitable<void> DryRuns::conclude(std::uint64_t id, int status, std::string reason) {
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  json figures;
  try {
    const auto look = [file = folder_of(id) / "report.json"] {
      const json report = read_json_file(file);
      return report.is_object() ? figures_in(report) : json();
    };
    figures = co_await elsewhere(disk_, look);
  } catch (const std::exception&) {
    // The report is not as it should be: the run has no figures.
  }
  DryRunRecord* const run = found(id);
  if (!run) co_return;
  run->figures = std::move(figures);
  run->state = good ? DryRunRecord::State::done : DryRunRecord::State::failed;
  if (good) run->percent = 100;
  if (!good && WIFSIGNALED(status))
    reason = fmt::format("the dry run was ended by signal {}; try fewer layers, or a simpler model",
                         WTERMSIG(status));
  if (!good) run->reason = reason.empty() ? "the dry run gave no reason" : std::move(reason);
  log_line(fmt::format("dry run {} {}: {} {}", id, run->job, state_name(run->state), run->reason));
  note(*run);
  announce(*run);
}

asio::awaitable<void> DryRuns::remove(std::uint64_t id) {
  const DryRunRecord* const run = found(id);
  if (!run) throw no_such_run();
  if (run->state == DryRunRecord::State::running && process_) {
    const std::shared_ptr<TryingProcess> process = process_;
    process->end();
    asio::steady_timer timer(loop_);
    for (const auto end = std::chrono::steady_clock::now() + for_its_end; process_ == process;) {
      if (std::chrono::steady_clock::now() > end) process->kill();
      timer.expires_after(20ms);
      co_await timer.async_wait(asio::use_awaitable);
    }
  }
  std::erase_if(runs_, [id](const DryRunRecord& one) { return one.id == id; });
  changed_({{"event", "task"}, {"removed", id}});
  const auto clear = [folder = folder_of(id)] { return remove_folder(folder), true; };
  co_await elsewhere(disk_, clear);
}

asio::awaitable<std::string> DryRuns::file(std::uint64_t id, std::string name) {
  if (!find(id)) throw no_such_run();
  if (!is_shown(name)) throw no_such_file();
  const auto read_all = [file = folder_of(id) / name] { return bytes_of(file); };
  co_return co_await elsewhere(disk_, read_all);
}

}  // namespace unicursal::host
