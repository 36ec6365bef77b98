#include "host/spool/chunk_reader.hpp"

#include <catch2/catch.hpp>

#include "host/spool/bytes.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;

namespace {

SpooledChunk chunk_of(std::vector<std::string> lines, std::vector<gcode::MixtureStart> mixtures) {
  SpooledChunk chunk;
  chunk.kind = SpooledChunk::Kind::layer;
  chunk.lines = std::move(lines);
  chunk.mixtures = std::move(mixtures);
  return chunk;
}

/// Eight lines in three chunks; the mixtures start at the lines 1, 3 and 7.
std::filesystem::path three_chunks(const test::TempFolder& folder) {
  RecordWriter writer(folder / "chunks", 0);
  writer.append(to_bytes(chunk_of({"G28", "T0", "G1 X1"}, {{1, "coral"}})));
  writer.append(to_bytes(chunk_of({"T1", "G1 X2"}, {{0, "0.02 : 0.74 : 0.24"}})));
  writer.append(to_bytes(chunk_of({"G1 X3", "G1 X4", "T2"}, {{2, "sea"}})));
  return folder / "chunks";
}

const std::vector<std::string> after_line{"",
                                          "coral",
                                          "coral",
                                          "0.02 : 0.74 : 0.24",
                                          "0.02 : 0.74 : 0.24",
                                          "0.02 : 0.74 : 0.24",
                                          "0.02 : 0.74 : 0.24",
                                          "sea"};

}  // namespace

TEST_CASE("a spooled chunk comes back with its mixtures") {
  const SpooledChunk chunk = chunk_of({"T0", "G1 X1", "T1"}, {{0, "coral"}, {2, "0.02 : 0.74 : 0.24"}});
  const SpooledChunk back = chunk_from(to_bytes(chunk));
  CHECK(back.lines == chunk.lines);
  CHECK(back.mixtures == chunk.mixtures);
  CHECK_THROWS_AS(chunk_from(to_bytes(chunk_of({"T0"}, {{1, "coral"}}))), DamagedBytes);
  CHECK_THROWS_AS(chunk_from(to_bytes(chunk_of({"T0"}, {{0, std::string(10000, 'x')}}))), DamagedBytes);
}

TEST_CASE("the mixture in use is known after any line that is read back") {
  const test::TempFolder folder;
  const std::filesystem::path chunks = three_chunks(folder);
  for (std::uint64_t line = 0; line < after_line.size(); ++line)
    CHECK(mixture_before(chunks, line + 1) == after_line[line]);
  CHECK(mixture_before(chunks, 0).empty());
  for (std::uint64_t first = 0; first <= after_line.size(); ++first) {
    for (const std::size_t most : {1u, 2u, 16u}) {
      LegReader reader(chunks, Leg{}, first);
      std::uint64_t line = first;
      for (auto lines = reader.next(most); !lines.empty(); lines = reader.next(most)) {
        line += lines.size();
        CHECK(reader.mixture() == after_line.at(line - 1));
      }
      CHECK(line == after_line.size());
      CHECK(reader.mixture() == "sea");
    }
  }
}

TEST_CASE("a lead-in goes on with the mixture of the line that it leads to") {
  const test::TempFolder folder;
  const std::filesystem::path chunks = three_chunks(folder);
  const Leg leg{{"G28 X Y", "T1"}, 4, 0.2};
  LegReader reader(chunks, leg, 0);
  CHECK(reader.next(16) == leg.lead_in);
  CHECK(reader.mixture() == after_line[3]);
  CHECK(reader.next(16) == std::vector<std::string>{"G1 X2"});
  CHECK(reader.mixture() == after_line[4]);
  CHECK(reader.next(16).size() == 3);
  CHECK(reader.mixture() == "sea");
}
