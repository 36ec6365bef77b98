// Measures what it costs to follow the line of a print (host/live): processor time for each line.
//   bench_live JOB.toml|FILE.gcode PROFILE.toml
//
// All chunks are made first; only following them is timed.
#include <fmt/core.h>

#include <ctime>
#include <exception>
#include <vector>

#include "host/engine/produce.hpp"
#include "host/job/load_job.hpp"
#include "host/live/live_line.hpp"

namespace {

using namespace unicursal;

struct Made {
  host::SpooledChunk kept;
  gcode::Chunk chunk;
};

Made made(host::SpooledChunk::Kind kind, gcode::Chunk chunk, gcode::PlacedLayer layer = {}) {
  Made one;
  one.kept.kind = kind;
  one.kept.layer = std::move(layer);
  one.kept.begun = host::layers_begun_in(chunk.lines);
  gcode::keep_commands(chunk);
  one.kept.lines = chunk.lines;
  one.kept.mixtures = chunk.mixtures;
  chunk.lines.clear();
  one.chunk = std::move(chunk);
  return one;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void measure(const std::string& file, const std::string& profile) {
  const auto production =
      host::produce(host::load_job_or_model(file, profile, host::UnnamedPrinter::refuse), {});
  production->begin(host::real_clock(), {});
  host::KeptSource& source = production->open({});
  std::vector<Made> all;
  all.push_back(made(host::SpooledChunk::Kind::start, source.start()));
  while (auto step = source.next())
    all.push_back(made(step->record.kind, std::move(step->chunk), std::move(step->record.layer)));
  std::size_t lines = 0;
  for (const Made& one : all) lines += one.kept.lines.size();
  host::LiveSubject subject;
  subject.printer = production->job().profile.printer;
  subject.filaments = production->job().profile.filaments;
  subject.asked = production->asked();
  subject.layers = production->layers();
  subject.folder = "/var/tmp";
  host::LiveLine live(subject);
  const double begun = cpu_seconds();
  std::uint64_t done = 0;
  for (const Made& one : all) {
    live.chunk_kept(one.kept, one.chunk);
    live.executed(done);
    done += one.kept.lines.size();
    live.wait();
  }
  const double seconds = cpu_seconds() - begun;
  fmt::print("{}: {} lines in {:.2f} s of processor time, {:.2f} µs each\n", file, lines, seconds,
             1e6 * seconds / static_cast<double>(lines));
}

}  // namespace

int main(int count, char** words) {
  try {
    if (count == 3) return measure(words[1], words[2]), 0;
    fmt::print(stderr, "usage: bench_live JOB.toml|FILE.gcode PROFILE.toml\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
  return 2;
}
