// Kept prints that are damaged, have names that cannot be kept, or were begun while the clock stood wrong:
// they are resumed at the right place, or refused, or a person is asked; z is never homed onto a part.
#include <catch2/catch.hpp>
#include <map>

#include "core/numeric/random.hpp"
#include "host/engine/produce.hpp"
#include "host/engine/restart.hpp"
#include "host/job/load_job.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/journal.hpp"
#include "host/spool/spool.hpp"
#include "tests/host/support/print_bench.hpp"

using namespace unicursal;
using test::Outcome;
using Bench = test::PrintBench;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

namespace {

/// The files of a kept print, to damage them and put them back.
class Kept {
 public:
  explicit Kept(fs::path folder) : folder_(std::move(folder)) {
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file())
        files_[fs::relative(entry.path(), folder_)] = test::read_text(entry.path());
    }
  }
  const std::map<std::string, std::string>& files() const { return files_; }
  const fs::path& folder() const { return folder_; }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary | std::ios::trunc) << bytes;
  }
  void restore() const {
    for (const auto& [name, bytes] : files_) write(name, bytes);
  }

 private:
  fs::path folder_;
  std::map<std::string, std::string> files_;
};

/// The bytes where each record of a file begins, and where the last one ends.
std::vector<std::size_t> borders(const fs::path& file) {
  host::RecordReader reader(file);
  std::vector<std::size_t> all{0};
  while (reader.next()) all.push_back(reader.sound());
  return all;
}

std::string flipped(std::string bytes, std::size_t at) {
  bytes[at] = static_cast<char>(bytes[at] ^ 4);
  return bytes;
}

std::string damaged_somehow(const std::string& bytes, core::Random& random) {
  if (bytes.empty()) return bytes;
  const std::size_t at = random.below(bytes.size());
  switch (random.below(6)) {
    case 0:
      return bytes.substr(0, at);
    case 1:
      return bytes.substr(0, at) + std::string(bytes.size() - at, '\0');
    case 2:
      return flipped(bytes, at);
    case 3:
      return std::string(bytes).replace(at, 1 + random.below(512), random.below(512), '\0');
    case 4:
      return random.below(8) == 0 ? std::string() : std::string(bytes.size(), '\0');
    default:
      return bytes.substr(0, at) + bytes.substr(random.below(bytes.size()));  // lost or doubled
  }
}

std::vector<std::string> lines_from(const fs::path& chunks, std::uint64_t line) {
  std::vector<std::string> all;
  host::LegReader reader(chunks, host::Leg{}, line);
  for (auto some = reader.next(1000); !some.empty(); some = reader.next(1000))
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// An interrupted print whose printer has lost its place.
struct Interrupted {
  explicit Interrupted(const Words& more = {"--fault", "reset@line=700"}) : bench(0, more) {
    REQUIRE(test::run(bench.print()).code == 1);
  }
  Bench bench;
};

void damage_at_random(std::size_t times, std::uint64_t seed) {
  const Interrupted print;
  const Kept kept(print.bench.print_folder());
  std::unique_ptr<host::Production> production;
  std::uint64_t certain = 0, sent = 0;
  std::vector<std::string> lines;
  {
    const host::Spool spool = host::Spool::open(kept.folder());
    production = host::produce(spool.job());
    certain = host::restart_after(*production, spool, {}).leg.begins_at;
    sent = spool.before().furthest;
    lines = lines_from(spool.chunks(), 0);
  }
  REQUIRE(certain > 0);
  core::Random random(seed);
  std::size_t refused = 0, resumed = 0;
  for (std::size_t i = 0; i < times; ++i) {
    for (std::size_t files = 1 + random.below(2); files > 0; --files) {
      static const Words often{"journal", "chunks", "print.json"};
      const std::size_t which = random.below(often.size() + 1);
      const auto any = std::next(kept.files().begin(), static_cast<long>(random.below(kept.files().size())));
      const std::string name = which < often.size() ? often[which] : any->first;
      kept.write(name, damaged_somehow(kept.files().at(name), random));
    }
    INFO("damage " << i << " of seed " << seed);
    try {
      const host::Spool spool = host::Spool::open(kept.folder());
      const host::Restart restart = host::restart_after(*production, spool, {});
      ++resumed;
      CHECK_FALSE(restart.from_start());  // also if both record files were cut back to the start lines
      const std::uint64_t begins = restart.leg.begins_at;
      CHECK(begins <= certain);                                             // no hole
      CHECK(begins + std::max(restart.repeated, restart.perhaps) >= sent);  // every repeated line is reported
      const std::vector<std::string> rest = lines_from(spool.chunks(), begins);
      CHECK(begins + rest.size() >= sent);
      CHECK(std::equal(rest.begin(), rest.end(), lines.begin() + static_cast<long>(begins)));
    } catch (const core::DataError& error) {
      ++refused;
      CHECK(std::string(error.what()).size() > 20);
    }
    kept.restore();
  }
  CHECK(refused > times / 2);
  CHECK(resumed > 0);
}

}  // namespace

TEST_CASE("a damaged print is refused before anything moves, and never begins from its start") {
  Interrupted print;
  const Kept kept(print.bench.print_folder());
  const std::string journal = kept.files().at("journal"), chunks = kept.files().at("chunks");
  const std::vector<std::size_t> events = borders(kept.folder() / "journal");
  const std::vector<std::size_t> records = borders(kept.folder() / "chunks");
  REQUIRE(events.size() > 20);
  REQUIRE(records.size() > 2);
  const std::string profile = "job/1/bench.toml";
  const std::vector<std::pair<std::string, std::string>> damages{
      {"journal", ""},                                            // empty
      {"journal", std::string(journal.size(), '\0')},             // zeroed
      {"journal", journal.substr(0, 5)},                          // torn in its first record
      {"journal", journal.substr(0, events[1])},                  // only the leg
      {"journal", journal.substr(0, events[4])},                  // far too short
      {"journal", flipped(journal, events[1] + 9)},               // damaged in the middle
      {"journal", flipped(journal, events[10])},                  // in a length
      {"chunks", ""},                                             //
      {"chunks", flipped(chunks, records[1] + 50)},               // in the middle
      {"chunks", chunks.substr(0, records[records.size() - 2])},  // the last one is lost
      {"print.json", test::replaced(kept.files().at("print.json"), "port", "pore")},  //
      {profile, kept.files().at(profile) + "\n# another\n"},
  };
  for (const auto& [name, bytes] : damages) {
    kept.write(name, bytes);
    const Outcome outcome = print.bench.resume_anyway();
    INFO(name << " of " << bytes.size() << " bytes: " << outcome.out << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("again") != std::string::npos);
    kept.restore();
  }
  const Outcome outcome = print.bench.resume_anyway();
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  const Words lines = print.bench.seen().lines;
  CHECK(std::count(lines.begin(), lines.end(), "G28") == 1);
  CHECK(std::count(lines.begin(), lines.end(), "G28 X Y") == 1);
}

TEST_CASE("300 random damages of a kept print end in the right place or in a refusal") {
  damage_at_random(300, 1);
}

TEST_CASE("2000 random damages of kept prints", "[long]") {
  for (std::uint64_t seed = 11; seed < 15; ++seed) damage_at_random(500, seed);
}

TEST_CASE("a print that looks as if it had sent nothing begins only if that is certain") {
  Interrupted print;
  const Kept kept(print.bench.print_folder());
  kept.write("journal", kept.files().at("journal").substr(0, borders(kept.folder() / "journal")[1]));
  kept.write("chunks", "");
  const Outcome cut_back = print.bench.resume_anyway();  // the part stands on the bed
  INFO(cut_back.out << cut_back.err);
  CHECK(cut_back.code == 2);
  CHECK(cut_back.err.find("part had been begun") != std::string::npos);
  kept.write("untouched", "");
  const Outcome asked = test::run(print.bench.resume());
  INFO(asked.out << asked.err);
  CHECK(asked.code == 2);
  CHECK(asked.err.find("--yes") != std::string::npos);
}

TEST_CASE("the newest print is the one that was begun last, whatever the clock said") {
  const Interrupted print({"--fault", "reset@line=700", "--fault", "reset@line=1400"});
  const fs::path first = print.bench.print_folder(), root = first.parent_path();
  REQUIRE(test::run(print.bench.print()).code == 1);
  for (const auto& entry : fs::directory_iterator(root)) {
    if (entry.is_directory() && entry.path() != first)
      fs::rename(entry.path(), root / "1970-01-02-000000-job");
  }
  Words older = print.bench.resume();
  older.insert(older.end(), {first.filename().string(), "--yes"});
  const Outcome refused = test::run(older);
  INFO(refused.out << refused.err);
  CHECK(refused.code == 2);
  CHECK(refused.err.find("1970-01-02-000000-job") != std::string::npos);
  const Outcome resumed = print.bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  CHECK(resumed.code == 0);
}

TEST_CASE("an older print is not printed over a newer one that was begun on another port") {
  const Interrupted old;
  const Bench other(0, {"--fault", "reset@line=700"});
  const fs::path first = old.bench.print_folder();
  REQUIRE(test::run({"print", other.path("job.toml"), "--port", other.path("port"), "--spool",
                     old.bench.path("spool"), "--full-quality"})
              .code == 1);
  Words resume = old.bench.resume();
  resume.insert(resume.end(), {first.filename().string(), "--yes"});
  const Outcome asked = test::run(resume);
  INFO(asked.out << asked.err);
  CHECK(asked.code == 2);
  CHECK(asked.out.find("Continue only if that was another printer") != std::string::npos);
  resume.insert(resume.end(), {"--port", other.path("port")});
  const Outcome refused = test::run(resume);
  INFO(refused.out << refused.err);
  CHECK(refused.code == 2);
  CHECK(refused.err.find("another print has begun") != std::string::npos);
}

TEST_CASE("the print that is thrown away is the one that was begun first, and only its owner reads a print") {
  const Bench bench(0);
  const host::Job job = host::load_job(bench.path("job.toml"));
  const fs::path root = bench.path("spool");
  host::PrintOrder order;
  order.job_name = "job";
  std::vector<fs::path> made;
  for (int i = 0; i < 7; ++i) {
    made.push_back(host::Spool::create(root, job, order).folder());
    const fs::path renamed = root / ("20" + std::to_string(50 - i) + "-01-01-000000-job");
    fs::rename(made.back(), renamed);
    made.back() = renamed;
  }
  const std::vector<fs::path> newest(made.rbegin(), made.rbegin() + 5);
  CHECK(host::kept_prints(root) == newest);
  const auto others = fs::perms::group_all | fs::perms::others_all;
  CHECK((fs::status(made.back()).permissions() & others) == fs::perms::none);
  for (const auto& entry : fs::recursive_directory_iterator(made.back())) {
    INFO(entry.path());
    CHECK((entry.status().permissions() & others) == fs::perms::none);
  }
}

TEST_CASE("a job whose name is not UTF-8 is refused with a sentence, and leaves nothing") {
  const Bench bench(0);
  const fs::path job = bench.folder().write("caf\xe9.toml", test::sample_job);
  const Outcome outcome =
      test::run({"print", job.string(), "--port", bench.path("port"), "--spool", bench.path("spool")});
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("UTF-8") != std::string::npos);
  CHECK((!fs::exists(bench.path("spool")) || fs::is_empty(bench.path("spool"))));
}
