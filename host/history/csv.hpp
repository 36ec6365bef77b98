// The history as a table for spreadsheets (RFC 4180): lines end with CR LF, a line for each filament of each
// print. A text that a spreadsheet would take for a formula gets an apostrophe before it (OWASP, CSV
// injection). Times are in UTC (ISO 8601).
#pragma once

#include <string>
#include <vector>

#include "host/history/past_print.hpp"

namespace unicursal::host {

std::string csv_of(const std::vector<PastPrint>& prints);

}  // namespace unicursal::host
