// What a drawing holds that the print will show otherwise, or not at all. Each kind is one sentence, which
// names the first place and counts the others.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "core/text/wording.hpp"

namespace unicursal::core {

enum class Finding {
  faint,        ///< less than half opaque
  translucent,  ///< half opaque or more
  hairline,
  outside,  ///< beyond the page
  soft_mask,
  filter,
  blend,
  pattern,
  missing_server,
  missing_target,
  circle_of_links,
  picture,
  foreign,
  text_on_path,
  text_look,
};
inline constexpr std::size_t finding_kinds = std::size_t(Finding::text_look) + 1;

class DrawingNotes {
 public:
  explicit DrawingNotes(Warnings& notes) : notes_(notes) {}

  /// `where` names the element.
  void add(Finding finding, const std::string& where) {
    Tally& tally = tallies_[std::size_t(finding)];
    if (tally.count++ == 0) tally.first = where;
  }
  std::size_t count(Finding finding) const { return tallies_[std::size_t(finding)].count; }
  /// A sentence of its own.
  void say(std::string sentence) { notes_.add(std::move(sentence)); }
  Warnings& sentences() { return notes_; }
  /// Hands the sentences over.
  void finish();

 private:
  struct Tally {
    std::size_t count = 0;
    std::string first;
  };
  Warnings& notes_;
  std::array<Tally, finding_kinds> tallies_;
};

}  // namespace unicursal::core
