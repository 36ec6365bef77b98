#include "host/engine/sliced_production.hpp"

#include <algorithm>
#include <utility>

#include "core/stopping.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

constexpr double least_flow = 0.1;  ///< mm³/s

gcode::Remix remix_of(std::istream& file, const PreparedSliced& prepared) {
  gcode::RemixSettings settings = remix_settings(prepared);
  settings.stop = [] { core::stop_point(); };
  return {file, prepared.file().string(), prepared.job.profile.printer, prepared.survey, settings};
}

SpoolError changed_copy(const Spool& spool) {
  return {spool.folder().string(), "", "holds more lines than its copy of the G-code makes",
          "resume with the version that the print was begun with"};
}

}  // namespace

/// The file's chunks, in order.
class SlicedProduction::Steps final : public KeptSource {
 public:
  explicit Steps(SlicedProduction& of) : of_(of) {}
  ~Steps() override { of_.ahead_.on_ready({}); }

  const gcode::Printer& printer() const override { return of_.job().profile.printer; }
  core::Box extent() const override { return of_.extent(); }
  double flow() const override { return of_.flow(); }
  std::vector<std::string> warnings() const override;
  std::size_t layers() const override { return of_.layers(); }
  gcode::Chunk start() override { return ++made_, of_.start_; }
  bool ready() const override { return cancelled_ || of_.ahead_.ready(); }
  void on_ready(std::function<void()> listener) override { of_.ahead_.on_ready(std::move(listener)); }
  std::optional<PrintStep> next() override;
  gcode::Chunk finish() override;
  void cancel() override {
    cancelled_ = true;
    of_.unwanted_.request_stop();
  }
  bool cancelled() const override { return cancelled_; }
  std::size_t made() const override { return made_; }
  void printed(double, double) override {}
  Waiting waiting() const override { return of_.ahead_.waiting(); }
  std::optional<double> foretold(std::size_t begin, std::size_t end) const override;

 private:
  SlicedProduction& of_;
  bool cancelled_ = false;
  bool ended_ = false;  ///< next() has given the last chunk
  std::size_t made_ = 0;
};

std::vector<std::string> SlicedProduction::Steps::warnings() const {
  std::vector<std::string> all = of_.job().warnings;
  const std::vector<std::string>& notes = of_.prepared_.survey.notes;
  all.insert(all.end(), notes.begin(), notes.end());
  all.insert(all.end(), of_.late_warnings_.begin(), of_.late_warnings_.end());
  return all;
}

std::optional<PrintStep> SlicedProduction::Steps::next() {
  if (cancelled_) return std::nullopt;
  std::optional<RemixedChunk> made = of_.ahead_.wait();
  if (!made) {
    ended_ = true;
    return std::nullopt;
  }
  ++made_;
  const std::vector<std::string>& warnings = made->chunk.warnings;
  of_.late_warnings_.insert(of_.late_warnings_.end(), warnings.begin(), warnings.end());
  if (of_.listener_) of_.listener_->chunk_made(*made);
  PrintStep step;
  step.record.kind = SpooledChunk::Kind::stretch;
  step.chunk = std::move(made->chunk);
  return step;
}

/// The nozzle may stand anywhere in what was handed out, behind which the remix may be far ahead.
gcode::Chunk SlicedProduction::Steps::finish() {
  of_.ahead_.stop();
  gcode::Chunk chunk = of_.remix_.finish(!ended_);
  ++made_;
  if (of_.listener_) of_.listener_->end_made(chunk);
  return chunk;
}

std::optional<double> SlicedProduction::Steps::foretold(std::size_t begin, std::size_t end) const {
  const std::vector<double>& seconds = of_.prepared_.survey.layer_seconds;
  end = std::min(end, seconds.size());
  begin = std::min(begin, end);
  const std::vector<double>& in_tower = of_.prepared_.survey.tower_seconds;
  const bool tower = of_.prepared_.job.sliced->tower;
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += seconds[i] - (tower ? 0 : in_tower.at(i));
  return sum;
}

SlicedProduction::SlicedProduction(PreparedSliced prepared)
    : prepared_(std::move(prepared)),
      file_(prepared_.file(), std::ios::binary),
      remix_(remix_of(file_, prepared_)),
      start_(remix_.start()),
      late_warnings_(start_.warnings),
      ahead_(remix_) {}

SlicedProduction::~SlicedProduction() {
  source_.reset();
  ahead_.stop();
}

double SlicedProduction::flow() const {
  const gcode::SlicedSurvey& survey = prepared_.survey;
  const double mean = survey.seconds > 0 ? survey.volume / survey.seconds : 0;
  return std::clamp(mean, least_flow, std::max(prepared_.job.profile.printer.max_flow, least_flow));
}

void SlicedProduction::listen(RemixListener* listener) {
  listener_ = listener;
  if (listener) remix_.listen();
}

AskedMaterials SlicedProduction::asked() const {
  AskedMaterials asked{remix_settings(prepared_).materials, {}};
  for (std::size_t i = 0; i < asked.materials.size(); ++i) asked.materials[i].mixture = remix_.intended(i);
  return asked;
}

/// A print that continues is remixed from its beginning first (catch_up()).
void SlicedProduction::begin(const std::shared_ptr<Clock>&, const SpoolExtent& kept) {
  begun_ = kept.chunks == 0;
  if (begun_) ahead_.begin();
}

KeptSource& SlicedProduction::open(const SpoolExtent&) {
  source_ = std::make_unique<Steps>(*this);
  return *source_;
}

void SlicedProduction::catch_up(const Spool& spool) {
  if (begun_) return;
  const core::StopScope scope(unwanted_.get_token());
  ChunkReader reader(spool.chunks());
  bool finished = false;
  while (const auto kept = reader.next()) {
    std::optional<gcode::Chunk> made;
    switch (kept->kind) {
      case SpooledChunk::Kind::start:
        made = start_;
        break;
      case SpooledChunk::Kind::finish:
        finished = true;
        if (!remix_.next()) made = remix_.finish(false);
        break;
      case SpooledChunk::Kind::stretch:
        made = remix_.next();
        break;
      case SpooledChunk::Kind::layer:
      case SpooledChunk::Kind::rest:
        break;
    }
    if (!made) throw changed_copy(spool);
    check_same(*made, *kept, spool);
    remix_.wanted();
  }
  begun_ = true;
  if (finished)
    ahead_.stop();
  else
    ahead_.begin();
}

}  // namespace unicursal::host
