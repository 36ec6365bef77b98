// Changes the transition's two numbers in the text of a profile and leaves every other character as it is:
// comments, order, spaces, line ends. A comment behind a number keeps its column if there is room.
#pragma once

#include <filesystem>
#include <string>

namespace unicursal::host {

/// `text` with transition.dead_volume and transition.mixing_volume set to these values (mm³, two decimals),
/// added where they are missing. Throws JobError if `text` is not TOML, or is written in a form that this
/// cannot edit; `file` is for messages.
std::string with_transition(const std::string& text, double dead_volume, double mixing_volume,
                            const std::filesystem::path& file);

/// The text of a profile as it was when this was made.
class ProfileText {
 public:
  /// Throws core::FileError.
  explicit ProfileText(std::filesystem::path file);

  /// Replaces the file by the changed text. Throws core::FileError, also if the file has been changed
  /// meanwhile, and JobError; the file is untouched then.
  void set_transition(double dead_volume, double mixing_volume) const;

 private:
  std::filesystem::path file_;
  std::string text_;
};

}  // namespace unicursal::host
