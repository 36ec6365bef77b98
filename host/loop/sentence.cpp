#include "host/loop/sentence.hpp"

#include <new>

namespace unicursal::host {

std::string sentence(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return "memory ran out; close other programs or choose a coarser job";
  } catch (const std::exception& known) {
    return known.what();
  } catch (...) {
    return "something unknown went wrong";
  }
}

}  // namespace unicursal::host
