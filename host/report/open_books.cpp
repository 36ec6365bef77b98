#include "host/report/open_books.hpp"

#include "host/engine/planned_production.hpp"
#include "host/engine/sliced_production.hpp"
#include "host/report/planned_books.hpp"
#include "host/report/sliced_books.hpp"

namespace unicursal::host {

std::unique_ptr<Books> open_books(Production& production, const std::string& command,
                                  const RunOutputs& outputs) {
  if (auto* const sliced = dynamic_cast<SlicedProduction*>(&production))
    return std::make_unique<SlicedBooks>(*sliced, command, outputs);
  return std::make_unique<PlannedBooks>(dynamic_cast<PlannedProduction&>(production).maker(), command,
                                        outputs);
}

}  // namespace unicursal::host
