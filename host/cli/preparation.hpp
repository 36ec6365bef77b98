// What commands do before they print or write anything: prepare the job, and check the names of outputs.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <new>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/engine/production.hpp"
#include "host/job/load_job.hpp"

namespace unicursal::host {

/// Throws core::DataError for an output that is the same file as an input or another output.
void check_outputs(std::vector<std::filesystem::path> inputs,
                   const std::vector<std::filesystem::path>& outputs);

/// Returns those paths that are not absent.
std::vector<std::filesystem::path> present(std::initializer_list<std::optional<std::filesystem::path>> paths);

/// Shows a note on standard error.
void show_note(const std::string& sentence);

/// Shows on standard error what became known while layers were made.
void show_late_warnings(const std::vector<std::string>& sentences);

/// Returns what `read` returns. Throws core::DataError if the memory for reading `file` runs out.
template <class Read>
auto within_memory(const std::filesystem::path& file, const Read& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw core::DataError(file.string(), "", "the model needs more memory than the program may use",
                          "simplify it, or allow the program more memory");
  }
}

/// Loads, checks and places a job, and shows its warnings on standard error. Also checks the outputs of the
/// options and `more_outputs` (check_outputs). Throws core::DataError.
PreparedJob prepare_and_warn(const JobOptions& options,
                             const std::vector<std::filesystem::path>& more_outputs = {},
                             UnnamedPrinter unnamed = UnnamedPrinter::assume_common_frame);
/// The same, ready to be printed.
std::unique_ptr<Production> produce_and_warn(const JobOptions& options,
                                             const std::vector<std::filesystem::path>& more_outputs = {},
                                             UnnamedPrinter unnamed = UnnamedPrinter::assume_common_frame);

}  // namespace unicursal::host
