// The books of a print, whatever it is made from.
//
//   const std::unique_ptr<Books> books = open_books(production, "print", {.report = "out.json"});
//   …                                                     // the production makes its chunks
//   books->write_report(extra);
#pragma once

#include <memory>
#include <string>

#include "host/engine/production.hpp"
#include "host/report/books.hpp"

namespace unicursal::host {

/// Opens the outputs and listens to the production, which must not have made a layer yet and must outlive the
/// books. Throws core::DataError, before anything is sent.
std::unique_ptr<Books> open_books(Production& production, const std::string& command,
                                  const RunOutputs& outputs);

}  // namespace unicursal::host
