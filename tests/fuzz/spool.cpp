#include "tests/fuzz/spool.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/spool/chunk_reader.hpp"
#include "host/spool/journal.hpp"
#include "tests/fuzz/damage.hpp"

namespace unicursal::test {
namespace {

namespace fs = std::filesystem;

fs::path write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

/// A journal or chunks with damaged records, most of which have a valid checksum.
std::string damaged_records(const std::vector<std::string>& contents, core::Random& random) {
  std::string bytes;
  for (const std::string& content : contents) {
    const std::string record = random.below(3) == 0 ? damaged(content, random) : content;
    bytes += host::framed_record(record);
  }
  return random.below(4) == 0 ? damaged(bytes, random) : bytes;
}

std::vector<std::string> contents_of(const fs::path& file) {
  std::vector<std::string> contents;
  host::RecordReader reader(file);
  while (auto content = reader.next()) contents.push_back(std::move(*content));
  return contents;
}

}  // namespace

void journal(const fs::path& folder, core::Random& random) {
  const fs::path file = write(folder / "journal", "");
  {
    host::Journal sound(file, 0);
    sound.begin_leg({});
    sound.begin_session();
    sound.anchor({1, 0}, true);
    sound.anchor({70000, 69990}, false);
    sound.progress(70020, 70000);
    sound.park({"G91", "G1 Z10", "M104 S0"});
    sound.end({host::LegOutcome::stopped, "the user"});
    sound.begin_leg({{"G28 X Y", "G92 Z1"}, 600, 0.4});
  }
  write(file, damaged_records(contents_of(file), random));
  std::uint64_t kept = 0;
  const host::JournalState state = host::read_journal(file, &kept);
  state.place_of(static_cast<std::uint32_t>(random.below(100000)));
  if (kept > fs::file_size(file)) throw std::runtime_error("more is sound than there is");
}

void chunks(const fs::path& folder, core::Random& random) {
  host::SpooledChunk start, layer;
  start.lines = {"M104 S210", "G28", "M83", "M163 S0 P1", "M164 S0", "G1 Z.2 F600", "G0 X1 Y2"};
  layer.kind = host::SpooledChunk::Kind::layer;
  layer.layer.paths = {{{{{1, 2}, 0.3, 0}, {{4, 5}, 0.6, 1}}}};
  layer.efforts = {{3, 4}, {}};
  layer.lines = {"G1 X3 Y4 E.5 F900", "G1 E-4", "G91", "G1 X-1 Z.5"};
  const fs::path file =
      write(folder / "chunks", damaged_records({host::to_bytes(start), host::to_bytes(layer)}, random));
  host::SpoolExtent extent;
  host::ChunkReader chunk_reader(file);
  while (const auto chunk = chunk_reader.next()) extent.add(*chunk);
  if (chunk_reader.sound() > fs::file_size(file)) throw std::runtime_error("more is sound than there is");
  const host::Leg leg{{"G28 X Y", "G92 Z1"}, random.below(14), 0.4};
  const std::uint64_t place = random.below(20);
  host::state_at(file, leg, place);
  host::LegReader reader(file, leg, place);
  while (!reader.next(3).empty()) {
  }
}

}  // namespace unicursal::test
