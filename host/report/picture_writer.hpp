// Draws the curves of each layer in the background, so that neither planning nor the link waits for it.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>

#include "host/report/curve_picture.hpp"

namespace unicursal::host {

/// Throws core::FileError when there is no folder of that name and none can be made.
void make_picture_folder(const std::filesystem::path& folder);

class PictureWriter {
 public:
  /// Makes the folder. Throws core::FileError when that is not possible.
  PictureWriter(std::filesystem::path folder, CurveStyle style);

  /// Writes curve-NNNN.png by the layer's index. At most one picture is being drawn; waits for the one
  /// before.
  void draw(PlannedLayer layer);
  /// Waits for the last picture.
  void finish();

  /// What went wrong, if a picture could not be written; no more are tried then, and the print goes on.
  const std::optional<std::string>& problem() const { return problem_; }

 private:
  std::filesystem::path folder_;
  CurveStyle style_;
  std::future<void> drawing_;
  std::optional<std::string> problem_;
};

}  // namespace unicursal::host
