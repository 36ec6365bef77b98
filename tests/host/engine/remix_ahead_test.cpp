// Remixing ahead of the nozzle is bounded, ends when it is asked to, and reports errors in their turn.
#include "host/engine/remix_ahead.hpp"

#include <poll.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "core/error.hpp"
#include "host/engine/prepared_sliced.hpp"
#include "host/job/load_job.hpp"
#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;

namespace {

/// A sliced block of many layers whose start has been given.
class Remixed {
 public:
  explicit Remixed(std::size_t layers) {
    gcode::test::BlockOptions options;
    options.layers = layers;
    folder_.write("bench.toml", test::sample_profile);
    const auto file = folder_.write("block.gcode", gcode::test::sliced_block(options).text);
    prepared_ =
        prepare_sliced(load_job_or_model(file, folder_.path() / "bench.toml", UnnamedPrinter::refuse));
    stream_.open(file, std::ios::binary);
    remix_.emplace(stream_, file.string(), prepared_.job.profile.printer, prepared_.survey,
                   remix_settings(prepared_));
    remix_->start();
  }
  gcode::Remix& remix() { return *remix_; }
  /// Of all chunks, without a thread.
  std::vector<std::string> lines() {
    std::vector<std::string> all;
    while (const auto chunk = remix_->next()) all.insert(all.end(), chunk->lines.begin(), chunk->lines.end());
    return all;
  }

 private:
  test::TempFolder folder_;
  PreparedSliced prepared_;
  std::ifstream stream_;
  std::optional<gcode::Remix> remix_;
};

}  // namespace

TEST_CASE("Chunks that were made ahead are those that are made without, in order") {
  Remixed plain(12), threaded(12);
  RemixAhead ahead(threaded.remix());
  ahead.begin();
  std::vector<std::string> lines;
  while (const auto made = ahead.wait())
    lines.insert(lines.end(), made->chunk.lines.begin(), made->chunk.lines.end());
  CHECK((lines == plain.lines()));
  CHECK(ahead.ready());
}

TEST_CASE("What waits is bounded however slowly it is printed, and stopping gives the remix back") {
  Remixed block(200);
  RemixAhead ahead(block.remix());
  ahead.begin();
  REQUIRE(ahead.wait());
  for (int i = 0; i < 200; ++i) poll(nullptr, 0, 1);
  CHECK(ahead.most_waiting() >= 2);
  CHECK(ahead.most_waiting() <= 64);
  CHECK(ahead.waiting().seconds < 300);
  ahead.stop();
  CHECK(ahead.ready());
  CHECK_FALSE(ahead.wait());
  CHECK_FALSE(block.remix().finish(true).lines.empty());
}
