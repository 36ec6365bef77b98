// Draws the curves of each layer in a thread of its own, so that neither planning nor the link waits.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>

#include "host/report/curve_picture.hpp"

namespace unicursal::host {

/// Throws core::FileError if there is no folder of that name and none can be made.
void make_picture_folder(const std::filesystem::path& folder);

class PictureWriter {
 public:
  /// Makes the folder. Throws core::FileError if that is not possible.
  PictureWriter(std::filesystem::path folder, CurveStyle style);

  /// Starts to draw curve-NNNN.png, NNNN being the layer's index, after waiting for the picture before.
  void draw(PlannedLayer layer);
  /// Waits for the last picture.
  void finish();

  /// In the part's frame.
  PicturePlace place() const { return place_of_curves(style_); }
  /// Why a picture could not be written; absent if all were. After a problem no more pictures are drawn.
  const std::optional<std::string>& problem() const { return problem_; }

 private:
  std::filesystem::path folder_;
  CurveStyle style_;
  std::future<void> drawing_;
  std::optional<std::string> problem_;
};

}  // namespace unicursal::host
