#include "host/live/line_run.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

namespace unicursal::host {
namespace {

constexpr std::uint64_t state_every = 512;  ///< lines
constexpr std::size_t most_fed = 4096;      ///< different mixtures; a gradient has some dozens
constexpr double least_stretch = 0.5, most_stretch = 10;

/// The index of the first that begins at or behind the line.
template <typename Starts>
auto from_line(const Starts& starts, std::size_t line) {
  return std::lower_bound(starts.begin(), starts.end(), line,
                          [](const auto& start, std::size_t of) { return start.line < of; });
}

}  // namespace

LineRun::LineRun(const gcode::Printer& printer, const picture::Filaments& filaments, LiveLayers& layers,
                 LineTable& table)
    : printer_(printer),
      filaments_(filaments),
      layers_(layers),
      table_(table),
      head_{0, LineReader(printer), NozzleFlow(printer), LaidPath::nothing_asked, {}, 0, 0, {}},
      coloured_(gcode::Mixture::equal(printer.feeders).shares()),
      colour_(picture::colour_of({coloured_.begin(), coloured_.size()}, filaments)) {}

void LineRun::append(LineBatch batch) {
  batch.first = end_;
  batch.stretch = last_stretch_;
  end_ += batch.size();
  batches_.push_back(std::move(batch));
}

/// Precondition: the line has been appended, and not dropped.
LineBatch& LineRun::batch_at(std::uint64_t line) {
  const auto behind = std::upper_bound(
      batches_.begin(), batches_.end(), line,
      [](std::uint64_t of, const LineBatch& batch) { return of < batch.first + batch.size(); });
  assert(behind != batches_.end());
  return *behind;
}

void LineRun::keep_state() {
  head_.mark = layers_.mark();
  head_.poured = table_.poured();
  kept_.push_back(head_);
}

bool LineRun::run(std::size_t most) {
  while (most > 0 && head_.line < end_) {
    LineBatch& batch = batch_at(head_.line);
    const std::uint64_t end = batch.first + batch.size();
    for (; most > 0 && head_.line < end; --most) {
      if (kept_.empty() || head_.line >= kept_.back().line + state_every) {
        keep_state();
      }
      run_line(batch, static_cast<std::size_t>(head_.line - batch.first));
      ++head_.line;
    }
    if (head_.line == end) end_batch(batch);
  }
  return head_.line < end_;
}

/// By now it is known how long the chunk's lines seemed to take, and by the time model they take.
void LineRun::end_batch(LineBatch& batch) {
  if (batch.ends_layer) layers_.end();
  if (std::exchange(batch.whole, true) || batch.seconds <= 0 || !table_.holds(batch.first)) return;
  const double seemed = table_.seconds_from(batch.first);
  if (seemed <= 0) return;
  const double factor = batch.seconds / seemed;
  batch.stretch = last_stretch_ = std::clamp(batch.stretch * factor, least_stretch, most_stretch);
  table_.stretch(batch.first, factor);
}

void LineRun::begin_line(LineBatch& batch, std::size_t index) {
  for (auto layer = from_line(batch.begun, index); layer != batch.begun.end() && layer->line == index;
       ++layer)
    layers_.begin(layer->top);
  for (auto mixture = from_line(batch.mixtures, index);
       mixture != batch.mixtures.end() && mixture->line == index; ++mixture)
    head_.name = mixture->name;
  for (auto asked = from_line(batch.asked, index); asked != batch.asked.end() && asked->line == index;
       ++asked)
    head_.asked = static_cast<std::uint8_t>(std::min<std::size_t>(asked->material, LaidPath::nothing_asked));
}

void LineRun::run_line(LineBatch& batch, std::size_t index) {
  begin_line(batch, index);
  const LineMotion motion = head_.reader.read(batch.line(index));
  if (!motion.moves) return;
  LineStep step;
  step.line = head_.line;
  step.seconds = static_cast<float>(motion.seconds * batch.stretch);
  step.z = static_cast<float>(head_.reader.height().value_or(0));
  if (const auto place = head_.reader.place()) {
    step.x = static_cast<float>(place->x());
    step.y = static_cast<float>(place->y());
  }
  if (layers_.size() > 0) {
    step.layer = static_cast<std::uint32_t>(layers_.size() - 1);
    step.first_bead = static_cast<std::uint32_t>(layers_.beads());
  }
  const double poured = table_.poured();
  if (motion.travels && motion.volume > 0) {
    head_.fed = number_of_fed();
    step.lays = true;
    lay(motion, step);
  } else {
    feed_aside(motion);
    if (motion.travels && layers_.size() > 0) {
      LaidPath& path = layers_.path(motion.from);
      path.travel(motion.from);
      path.travel(motion.to);
    }
  }
  if (layers_.size() > 0) step.beads = static_cast<std::uint32_t>(layers_.beads()) - step.first_bead;
  step.fed = head_.fed;
  step.volume = static_cast<float>(table_.poured() - poured);
  table_.add(step);
}

/// A bead is cut where its colour changes.
void LineRun::lay(const LineMotion& motion, LineStep& step) {
  LaidPath* path = nullptr;
  if (step.layer != LineStep::no_layer) {
    path = &layers_.path(motion.from);
    path->travel(motion.from);
  }
  const core::Vec2 way = motion.to - motion.from;
  const double length = way.norm();
  const double height = path ? layers_.height() : 1;
  const double width = motion.volume / length / height;
  double done = 0;
  std::optional<picture::Colour> colour;
  const auto leaves = [&](double volume, const gcode::Shares& shares) {
    const picture::Colour next = colour_of(shares);
    if (path && colour && next != *colour)
      path->lay(motion.from + way * (done / motion.volume), width, head_.asked, *colour);
    colour = next;
    done += volume;
    table_.leave(volume, shares);
  };
  head_.flow.feed(head_.reader.fed(), motion.volume, std::ref(leaves));
  if (!path) return;
  if (colour)
    path->lay(motion.to, width, head_.asked, *colour);
  else
    path->travel(motion.to);  // everything went into the void of a retraction
}

void LineRun::feed_aside(const LineMotion& motion) {
  if (motion.volume == 0) return;
  const auto leaves = [this](double volume, const gcode::Shares& shares) { table_.leave(volume, shares); };
  head_.flow.feed(head_.reader.fed(), motion.volume, std::ref(leaves));
}

void LineRun::interpose(const std::vector<std::string>& lines, std::uint64_t line) {
  line = std::min(line, end_);
  while (!kept_.empty() && kept_.back().line > line) kept_.pop_back();
  if (head_.line > line) {
    if (kept_.empty()) return;  // too long ago
    head_ = kept_.back();
    kept_.pop_back();
    layers_.back_to(head_.mark);
    table_.back_to(head_.line, head_.poured);
  }
  run(static_cast<std::size_t>(line - head_.line));
  for (const std::string& one : lines) feed_aside(head_.reader.read(one));
  keep_state();
}

void LineRun::drop_before(std::uint64_t line) {
  table_.drop_before(line);
  while (kept_.size() > 1 && kept_[1].line <= line) kept_.pop_front();
  const std::uint64_t needed = kept_.empty() ? head_.line : std::min(head_.line, kept_.front().line);
  while (!batches_.empty() && batches_.front().first + batches_.front().size() <= needed)
    batches_.pop_front();
}

std::uint16_t LineRun::number_of_fed() {
  const gcode::Shares& shares = head_.reader.fed();
  if (head_.fed < fed_.size() && fed_[head_.fed].shares == shares && fed_[head_.fed].name == head_.name)
    return head_.fed;
  const auto known = std::find_if(fed_.begin(), fed_.end(), [&](const FedMixture& one) {
    return one.shares == shares && one.name == head_.name;
  });
  if (known == fed_.end() && fed_.size() < most_fed) {
    fed_.push_back({head_.name, shares});
    return static_cast<std::uint16_t>(fed_.size() - 1);
  }
  if (known == fed_.end()) return 0;
  return static_cast<std::uint16_t>(known - fed_.begin());
}

picture::Colour LineRun::colour_of(const gcode::Shares& shares) {
  if (shares == coloured_) return colour_;
  coloured_ = shares;
  colour_ = picture::colour_of({shares.begin(), shares.size()}, filaments_);
  return colour_;
}

}  // namespace unicursal::host
