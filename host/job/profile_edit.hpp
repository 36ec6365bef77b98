// Changes values in the text of a profile and leaves every other character as it is: comments, order, spaces,
// line ends. A comment behind a value keeps its column if there is room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace unicursal::host {

struct ProfileChange {
  std::string table;                 ///< such as "transition"
  std::optional<std::size_t> index;  ///< in a list of tables, such as [[filament]]
  std::string key;
  std::string value;   ///< in TOML; its line ends become those of the profile
  std::string beside;  ///< the key behind which a new key is put, if the table has it
};

/// `text` with all changes; tables and keys that are missing are added. Throws JobError if `text` is not
/// TOML, or is written in a form that this cannot edit; `file` is for messages.
std::string with_changes(const std::string& text, std::span<const ProfileChange> changes,
                         const std::filesystem::path& file);

struct MeasuredTransition {
  double dead_volume = 0, mixing_volume = 0;  ///< mm³
  std::optional<std::size_t> tanks;           ///< absent: the profile keeps its own
};

/// `text` with transition.dead_volume, transition.mixing_volume (two decimals) and, if given,
/// transition.tanks set to these values.
std::string with_transition(const std::string& text, const MeasuredTransition& found,
                            const std::filesystem::path& file);

/// The text of a profile as it was when this was made.
class ProfileText {
 public:
  /// Throws core::FileError.
  explicit ProfileText(std::filesystem::path file);

  /// Replaces the file by the changed text. Throws core::FileError, also if the file has been changed
  /// meanwhile, and JobError; the file is untouched then.
  void set(std::span<const ProfileChange> changes) const;
  void set_transition(const MeasuredTransition& found) const;

 private:
  std::filesystem::path file_;
  std::string text_;
};

}  // namespace unicursal::host
