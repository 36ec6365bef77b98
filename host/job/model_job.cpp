#include "host/job/model_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/job/colour_mixture.hpp"
#include "host/job/profile_draft.hpp"
#include "host/job/written_job.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr double layer_per_nozzle = 0.5, highest_layer = 0.3;  ///< mm
constexpr double bead_per_nozzle = 1.25;
constexpr double step = 0.05;      ///< mm, to which these are rounded
constexpr int drawing_layers = 5;  ///< in which a drawing is extruded

double rounded(double length) {
  return std::max(1.0, std::round(length / step)) * step;
}

/// A bare key of TOML that is not taken yet.
std::string key_for(const std::string& select, std::set<std::string>& taken) {
  std::string key;
  for (const char c : select) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain) {
      key += c;
    } else if (!key.empty() && key.back() != '-') {
      key += '-';
    }
    if (key.size() >= 24) break;
  }
  while (!key.empty() && key.back() == '-') key.pop_back();
  if (key.empty()) key = "mixture";
  std::string unique = key;
  for (int n = 2; taken.contains(unique); ++n) unique = fmt::format("{}-{}", key, n);
  taken.insert(unique);
  return unique;
}

/// Not as short as a bead, and within what `over` allows.
bool can_be_followed(const core::DrawnGradient& gradient, double bead_width) {
  constexpr double farthest = 10000;  // mm
  return gradient.end - gradient.begin > bead_width && gradient.begin >= -farthest &&
         gradient.end <= farthest;
}

std::string head(const std::vector<fs::path>& files, const Profile& profile, const fs::path& folder,
                 const core::ModelContents& model) {
  const gcode::Printer& printer = profile.printer;
  const double layer = std::min(highest_layer, rounded(layer_per_nozzle * printer.nozzle));
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(toml_text(name_in_job(file, folder)));
  std::string text = "# Written by `unicursal new`. unicursal-job(5) explains all keys.\n";
  text += "printer = " + toml_text(name_in_job(profile.file, folder)) + "\n\n[part]\n";
  text +=
      "file = " + (names.size() == 1 ? names.front() : fmt::format("[{}]", fmt::join(names, ", "))) + "\n";
  if (model.drawing) {
    text +=
        fmt::format("height = {:.4g}        # mm, how far the drawing is extruded\n", drawing_layers * layer);
    text += fmt::format("#width = {:.4g}       # mm, to which the drawing is scaled\n", model.size.x());
  } else {
    text += "#scale = 1.0\n#rotate = [0, 0, 0]  # degrees about x, y and z\n";
  }
  text += fmt::format("layer_height = {:.4g}  # mm\n", layer);
  text +=
      fmt::format("bead_width = {:.4g}   # mm, from fold to fold of the curve\n", usual_bead_width(printer));
  text += "#perimeters = 1     # contours around the fill\n";
  if (std::any_of(model.zones.begin(), model.zones.end(), [](const auto& zone) { return zone.paint; })) {
    text += fmt::format("paint_depth = {:.4g}  # mm, how deep painted colours reach\n",
                        usual_paint_depth(usual_bead_width(printer)));
  }
  return text;
}

}  // namespace

double usual_bead_width(const gcode::Printer& printer) {
  return std::clamp(rounded(bead_per_nozzle * printer.nozzle), printer.bead_width_range[0],
                    printer.bead_width_range[1]);
}

double usual_paint_depth(double bead_width) {
  return 2 * bead_width;
}

ModelJob model_job(const std::vector<fs::path>& files, const Profile& profile, const fs::path& folder) {
  ModelJob job;
  job.contents = core::inspect_model(files, usual_paint_depth(usual_bead_width(profile.printer)));
  std::string of_what = "the feeders";
  if (profile.filaments.named) {
    std::vector<std::string> names;
    for (const Filament& filament : profile.filaments.of_feeders) names.push_back(toml_text(filament.name));
    of_what = fmt::format("{}", fmt::join(names, ", "));
  }
  std::string zones, mixtures = fmt::format("\n[mixture]           # shares of {}\n", of_what);
  std::set<std::string> keys;
  std::size_t uncoloured = 0;
  const auto add_mixture = [&](const std::string& key, const gcode::Shares& shares) {
    mixtures += fmt::format("{} = {}\n", key, shares_in_toml(shares));
  };
  for (const core::ZoneOffer& offer : job.contents.zones) {
    zones += fmt::format(
        "\n[[zone]]\nselect = {}  # {:.4g} {}\npattern = \"isotropic\"  # or parallel, anisotropic, {{ angle "
        "= 45 "
        "}}\n",
        toml_text(offer.select), offer.amount,
        job.contents.drawing ? "mm²" : (offer.paint ? "mm³ of paint" : "mm³"));
    const std::size_t feeders = profile.printer.feeders;
    if (offer.gradient && can_be_followed(*offer.gradient, usual_bead_width(profile.printer))) {
      const core::DrawnGradient& drawn = *offer.gradient;
      const std::string from = key_for(offer.select + " from", keys),
                        to = key_for(offer.select + " to", keys);
      zones += fmt::format(
          "mixture = {{ from = \"{}\", to = \"{}\", along = [{:.4g}, {:.4g}, 0], over = [{:.5g}, {:.5g}] "
          "}}{}\n",
          from, to, drawn.along.x(), drawn.along.y(), drawn.begin, drawn.end,
          drawn.has_more ? "  # without the colours between them" : "");
      add_mixture(from, shares_near(drawn.from, profile));
      add_mixture(to, shares_near(drawn.to, profile));
      continue;
    }
    const std::string key = key_for(offer.select, keys);
    zones += fmt::format("mixture = \"{}\"\n", key);
    add_mixture(
        key, offer.colour.empty() ? one_feeder(uncoloured++, feeders) : shares_near(offer.colour, profile));
  }
  job.text = head(files, profile, folder, job.contents) + zones + mixtures;
  return job;
}

}  // namespace unicursal::host
