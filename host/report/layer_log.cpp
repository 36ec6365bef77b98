#include "host/report/layer_log.hpp"

#include <cassert>
#include <nlohmann/json.hpp>

namespace unicursal::host {
namespace {

/// Replaces invalid UTF-8: file names come from the user.
std::string text_of(const nlohmann::json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

LayerLog::LayerLog(std::filesystem::path file) : file_(std::move(file)) {
  file_.stream() << "{\n\"layers\": [";
}

void LayerLog::add(const nlohmann::json& layer) {
  file_.stream() << (layers_++ == 0 ? "\n" : ",\n") << text_of(layer, -1);
}

void LayerLog::finish(const nlohmann::json& rest) {
  assert(rest.is_object());
  std::ostream& stream = file_.stream();
  stream << "\n]";
  for (const auto& [key, value] : rest.items())
    stream << ",\n" << text_of(key, -1) << ": " << text_of(value, 1);
  stream << "\n}\n";
  file_.publish();
}

void write_json(const std::filesystem::path& file, const nlohmann::json& value) {
  write_whole_file(file, text_of(value, 1) + "\n");
}

}  // namespace unicursal::host
