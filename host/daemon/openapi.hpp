// The API as an OpenAPI 3.1 document (spec.openapis.org/oas/v3.1.0), for programs that make clients from it.
// The addresses are those of the table of routes (route.hpp), so that none can be missing; the schemas lie in
// host/daemon/schemas.json. A test holds real answers against it.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace unicursal::host {

nlohmann::json openapi_document();

/// The text of host/daemon/schemas.json, which the build puts into the program.
extern const char* const api_schemas;

}  // namespace unicursal::host
