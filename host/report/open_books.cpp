#include "host/report/open_books.hpp"

#include "host/engine/planned_production.hpp"
#include "host/report/planned_books.hpp"

namespace unicursal::host {

std::unique_ptr<Books> open_books(Production& production, const std::string& command,
                                  const RunOutputs& outputs) {
  return std::make_unique<PlannedBooks>(dynamic_cast<PlannedProduction&>(production).maker(), command,
                                        outputs);
}

}  // namespace unicursal::host
