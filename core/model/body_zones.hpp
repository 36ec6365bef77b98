// Decides which zone a body, or a paint on it, belongs to.
//
// A zone selects, in this order of rank: a body by its own name or by its number ("body 2", counted from 1 in
// the order of the file); a material or filament, or a colour; an object around it; a file. The highest rank
// decides; two zones of the same rank are an error. With a file's name and a colon before it ("lid.3mf:body
// 2") a name holds for that file only.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/model/mesh_model.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

/// What a zone can select.
struct Selectable {
  std::filesystem::path file;
  std::string number;              ///< "body 2"; empty for paint
  std::vector<std::string> names;  ///< its own, then those of the objects around it; empty for paint
  Tint tint;
  bool paint = false;  ///< a file's zone does not select it: then it belongs to its body

  /// How messages name it.
  std::string label() const;
};

/// Whether any zone asks for a body by number.
bool selects_by_number(const std::vector<Zone>& zones);

class BodyZones {
 public:
  explicit BodyZones(const std::vector<Zone>& zones) : zones_(zones), used_(zones.size(), false) {}

  /// The zone's index; nullopt if no zone selects it. Throws ModelError if two do.
  std::optional<std::size_t> zone_of(const Selectable& thing);
  /// Throws ModelError if a zone has selected nothing so far.
  void refuse_unmatched() const;
  /// Sets what belongs to the zones that have selected something.
  void mark_matched(std::vector<bool>& matched) const;
  /// Everything that could be selected, for messages.
  std::string choices() const;

 private:
  const std::vector<Zone>& zones_;
  std::vector<bool> used_;
  std::vector<std::string> choices_;
  std::set<std::string> known_choices_;
};

}  // namespace unicursal::core
