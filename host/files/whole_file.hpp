// Output files are written under another name and renamed when whole, so that a reader or an interrupted
// run never leaves half a file. What is there already and is no plain file, /dev/null or a pipe, is written
// to as it is; of a symbolic link the file behind it is replaced, not the link.
#pragma once

#include <filesystem>
#include <fstream>

namespace unicursal::host {

/// The name that `file` has while it is being written.
std::filesystem::path draft_of(const std::filesystem::path& file);

/// Opens the draft, making the folder if it is missing. Throws core::FileError naming `file`.
std::ofstream open_draft(const std::filesystem::path& file);

/// Closes the stream and gives the draft its name. Throws core::FileError, and removes the draft then.
void publish_draft(std::ofstream& stream, const std::filesystem::path& file);

/// Closes the stream and removes what was written so far, where that is a draft.
void discard_draft(std::ofstream& stream, const std::filesystem::path& file) noexcept;

}  // namespace unicursal::host
