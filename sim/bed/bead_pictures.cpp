#include "sim/bed/bead_pictures.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <deque>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/picture/filaments.hpp"

namespace unicursal::sim {

namespace {

constexpr picture::Colour background{250, 249, 246};
constexpr double border_light = 0.45;  // of the bead's own colour
constexpr double core_part = 0.78;     // of the bead's width
constexpr double margin = 1;           // mm around the print
constexpr double longest_side = 4096;  // pixels
constexpr double widest_drawn = 5;     // mm: what a nozzle that stands still piles up is drawn no wider

/// A bead as it waits in the file. mm.
struct Record {
  float x0, y0, x1, y1, width;
  picture::Colour colour;
};

struct Frame {
  double left = 0, top = 0;  ///< mm, y up
  double scale = 1;          ///< pixels per mm
  std::size_t width = 1, height = 1;
};

Frame frame_of(const Extents& extents, double pixel, double around) {
  const double width = extents.max_x - extents.min_x + 2 * around;
  const double height = extents.max_y - extents.min_y + 2 * around;
  const double scale = std::min(1 / pixel, longest_side / std::max(width, height));
  const auto pixels = [scale](double mm) {
    return static_cast<std::size_t>(std::clamp(std::ceil(mm * scale), 1.0, longest_side));
  };
  return {extents.min_x - around, extents.max_y + around, scale, pixels(width), pixels(height)};
}

/// Draws borders as they come and cores one bead width behind, so that the round end of a new border never
/// bites into the core of the bead that it continues.
class Pen {
 public:
  Pen(picture::Image& image, const Frame& frame) : image_(image), frame_(frame) {}
  ~Pen() { finish_run(); }
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  void draw(const Record& bead) {
    if (!waiting_.empty() && (waiting_.back().x1 != bead.x0 || waiting_.back().y1 != bead.y0)) finish_run();
    stroke(bead, bead.width, picture::lit(bead.colour, border_light));
    waiting_.push_back(bead);
    ahead_ += length(bead);
    while (ahead_ - length(waiting_.front()) > waiting_.front().width) draw_core();
  }

 private:
  static double length(const Record& bead) { return std::hypot(bead.x1 - bead.x0, bead.y1 - bead.y0); }

  void stroke(const Record& bead, double width, picture::Colour colour) {
    const auto x = [this](double mm) { return (mm - frame_.left) * frame_.scale; };
    const auto y = [this](double mm) { return (frame_.top - mm) * frame_.scale; };
    image_.stroke(x(bead.x0), y(bead.y0), x(bead.x1), y(bead.y1), width * frame_.scale, colour);
  }
  void draw_core() {
    const Record& bead = waiting_.front();
    stroke(bead, bead.width * core_part, bead.colour);
    ahead_ -= length(bead);
    waiting_.pop_front();
  }
  void finish_run() {
    while (!waiting_.empty()) draw_core();
    ahead_ = 0;
  }

  picture::Image& image_;
  const Frame& frame_;
  std::deque<Record> waiting_;  ///< border drawn, core not yet
  double ahead_ = 0;            ///< mm of them
};

/// A longer print may have left more layers here than this one will have.
void remove_old_pictures(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("deposit-") && name.ends_with(".png")) old.push_back(entry.path());
  }
  for (const auto& file : old) std::filesystem::remove(file);
}

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), file.string());
}

}  // namespace

BeadPictures::BeadPictures(std::filesystem::path folder, double pixel)
    : folder_(std::move(folder)), waiting_(folder_ / ".deposit.beads"), pixel_(pixel) {
  std::filesystem::create_directories(folder_);
  remove_old_pictures(folder_);
  file_.reset(std::fopen(waiting_.c_str(), "w+b"));
  if (!file_) fail(waiting_);
}

BeadPictures::~BeadPictures() {
  std::error_code ignored;
  std::filesystem::remove(waiting_, ignored);
}

void BeadPictures::bead(std::size_t layer, const Bead& bead, double width) {
  beads_.resize(std::max(beads_.size(), layer + 1));
  ++beads_[layer];
  widest_ = std::max(widest_, width);
  for (Extents* extents : {&all_, &above_}) {
    if (layer == 0 && extents == &above_) continue;
    extents->include(bead.from);
    extents->include(bead.to);
  }
  const auto narrow = [](double mm) { return static_cast<float>(mm); };
  const Record record{narrow(bead.from.x),
                      narrow(bead.from.y),
                      narrow(bead.to.x),
                      narrow(bead.to.y),
                      narrow(std::min(width, widest_drawn)),
                      picture::mixed_filaments(bead.shares)};
  if (std::fwrite(&record, sizeof record, 1, file_.get()) != 1) fail(waiting_);
}

void BeadPictures::draw() {
  std::rewind(file_.get());
  const double around = margin + std::min(widest_ / 2, margin);
  for (std::size_t layer = 0; layer < beads_.size(); ++layer) {
    const Frame frame = frame_of(layer == 0 ? all_ : above_, pixel_, around);
    picture::Image image(frame.width, frame.height, background);
    {
      Pen pen(image, frame);
      for (std::uint64_t i = 0; i < beads_[layer]; ++i) {
        Record record{};
        if (std::fread(&record, sizeof record, 1, file_.get()) != 1) fail(waiting_);
        pen.draw(record);
      }
    }
    picture::write_png(folder_ / fmt::format("deposit-{:04}.png", layer), image);
  }
}

}  // namespace unicursal::sim
