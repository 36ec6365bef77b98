// The page `index.html` beside the pictures of a dry run: layers with a slider, four figures that are judged,
// and jumps to the worst places. It holds the figures, and shows them by the script and the style sheet
// beside it (host/web/viewer.ts); it needs no network.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "host/engine/session_types.hpp"
#include "host/report/books.hpp"
#include "host/report/deposit_check.hpp"
#include "host/report/motion_findings.hpp"
#include "host/report/volumes.hpp"

namespace unicursal::host {

/// All that a dry run has found out.
struct DryRunFindings {
  const Books& books;
  const StreamResult& stream;
  const nlohmann::json& simulator;  ///< its report
  const DepositCheck& laid;
  const MotionFindings& motion;
  const Comparison& comparison;
};

/// What the page shows; viewer.ts describes the keys.
nlohmann::json view_of(const DryRunFindings& findings);

/// `time`, `material`, `gaps` and `colours`: good, doubtful or bad.
nlohmann::json grades_in(const nlohmann::json& view);

/// Removes the page of an older dry run, whose pictures are going to be replaced.
void remove_view(const std::filesystem::path& folder);

/// Writes index.html, viewer.js and viewer.css. A program that was built without its web pages writes none.
/// Throws core::FileError.
void write_view(const std::filesystem::path& folder, const nlohmann::json& view);

/// The page with its figures, in which no text of theirs can become markup.
std::string view_html(const nlohmann::json& view);

}  // namespace unicursal::host
