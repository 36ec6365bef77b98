#include "host/report/picture_writer.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace unicursal::host {

void make_picture_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw core::FileError(folder.string(), "", "is not a folder that pictures can be written to",
                          "name a folder in a place where you may write");
  }
}

PictureWriter::PictureWriter(std::filesystem::path folder, CurveStyle style)
    : folder_(std::move(folder)), style_(std::move(style)) {
  make_picture_folder(folder_);
}

void PictureWriter::draw(PlannedLayer layer) {
  finish();
  if (problem_) return;
  drawing_ = std::async(std::launch::async, [this, planned = std::move(layer)] {
    const std::string name = fmt::format("curve-{:04}.png", planned.layer.index);
    picture::write_png(folder_ / name, draw_curves(planned, style_));
  });
}

void PictureWriter::finish() {
  if (!drawing_.valid()) return;
  try {
    drawing_.get();
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
}

}  // namespace unicursal::host
