#include "core/model/body_zones.hpp"

#include <algorithm>

#include "core/drawing/css_colour.hpp"
#include "core/error.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

enum Rank { not_at_all, file, object, tint, body };

bool names_file(std::string_view select, const std::filesystem::path& path) {
  const std::string wanted = lower(select);
  return wanted == lower(path.filename().string()) || wanted == lower(path.stem().string());
}

bool same(std::string_view a, std::string_view b) {
  return !a.empty() && lower(a) == lower(b);
}

Rank rank_of(std::string_view select, const Selectable& thing) {
  if (select.empty()) return not_at_all;
  if (same(select, thing.number)) return body;
  if (!thing.names.empty() && same(select, thing.names.front())) return body;
  const auto is_name = [&](const std::string& name) { return same(select, name); };
  const auto colour = css_colour(select);
  if (std::any_of(thing.tint.names.begin(), thing.tint.names.end(), is_name) ||
      (colour && *colour == thing.tint.colour)) {
    return tint;
  }
  if (std::any_of(thing.names.begin(), thing.names.end(), is_name)) return object;
  if (!thing.paint && names_file(select, thing.file)) return file;
  return not_at_all;
}

Rank rank_with_file(std::string_view select, const Selectable& thing) {
  const Rank rank = rank_of(select, thing);
  if (rank != not_at_all) return rank;
  for (auto colon = select.find(':'); colon != std::string_view::npos; colon = select.find(':', colon + 1)) {
    if (names_file(select.substr(0, colon), thing.file)) return rank_of(select.substr(colon + 1), thing);
  }
  return not_at_all;
}

}  // namespace

std::string Selectable::label() const {
  const std::string what = paint ? "the paint " : "the body ";
  std::string name = names.empty() ? number : in_quotes(names.front());
  if (name.empty()) name = tint.names.empty() ? tint.colour : in_quotes(tint.names.front());
  return what + name;
}

bool selects_by_number(const std::vector<Zone>& zones) {
  return std::any_of(zones.begin(), zones.end(), [](const Zone& zone) {
    const std::string select = lower(zone.select);
    const auto at = select.rfind("body ");
    const bool begins = at == 0 || (at != std::string::npos && select[at - 1] == ':');
    return begins && select.size() > at + 5 &&
           select.find_first_not_of("0123456789", at + 5) == std::string::npos;
  });
}

std::optional<std::size_t> BodyZones::zone_of(const Selectable& thing) {
  std::optional<std::size_t> found;
  Rank best = not_at_all;
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    const Rank rank = rank_with_file(zones_[i].select, thing);
    if (rank == not_at_all) continue;
    used_[i] = true;
    if (rank == best) {
      throw ModelError(thing.file.string(), "select = " + in_quotes(zones_[i].select),
                       thing.label() + " is already selected by " + in_quotes(zones_[*found].select),
                       "let only one zone select it");
    }
    if (rank > best) best = rank, found = i;
  }
  const auto offer = [&](const std::string& choice) {
    if (known_choices_.insert(choice).second) choices_.push_back(choice);
  };
  if (!thing.paint) offer(in_quotes(thing.file.filename().string()));
  for (const std::string& name : thing.names) offer(in_quotes(name));
  if (!thing.tint.colour.empty()) offer(in_quotes(thing.tint.colour));
  for (const std::string& name : thing.tint.names) offer(in_quotes(name));
  return found;
}

void BodyZones::refuse_unmatched() const {
  const auto unused = std::find(used_.begin(), used_.end(), false);
  if (unused == used_.end()) return;
  throw ModelError("", "select = " + in_quotes(zones_[std::size_t(unused - used_.begin())].select),
                   "this matches nothing in the files", "choose among " + choices());
}

void BodyZones::mark_matched(std::vector<bool>& matched) const {
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (used_[i]) matched.at(i) = true;
  }
}

std::string BodyZones::choices() const {
  return listed(choices_);
}

}  // namespace unicursal::core
