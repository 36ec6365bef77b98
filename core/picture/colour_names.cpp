#include "core/picture/colour_names.hpp"

#include <limits>

namespace unicursal::picture {
namespace {

struct Named {
  const char* name;
  Colour colour;
};

constexpr Named names[] = {
    {"black", {20, 20, 20}},         {"dark grey", {75, 75, 75}},      {"grey", {130, 130, 130}},
    {"light grey", {195, 195, 195}}, {"white", {248, 248, 246}},       {"cream", {245, 235, 205}},
    {"red", {205, 35, 40}},          {"dark red", {120, 25, 30}},      {"brown", {105, 65, 40}},
    {"light brown", {165, 115, 75}}, {"beige", {215, 190, 150}},       {"salmon", {240, 130, 110}},
    {"pink", {245, 170, 185}},       {"orange", {240, 125, 30}},       {"light orange", {245, 180, 100}},
    {"yellow", {245, 215, 40}},      {"pale yellow", {245, 230, 140}}, {"mustard", {190, 150, 40}},
    {"olive", {120, 125, 50}},       {"lime", {165, 205, 60}},         {"green", {55, 150, 70}},
    {"dark green", {25, 85, 50}},    {"pale green", {165, 215, 165}},  {"turquoise", {50, 175, 165}},
    {"teal", {20, 110, 115}},        {"cyan", {40, 170, 210}},         {"pale blue", {160, 200, 235}},
    {"blue", {40, 90, 190}},         {"dark blue", {30, 45, 105}},     {"violet", {110, 70, 170}},
    {"lilac", {185, 160, 215}},      {"purple", {110, 35, 110}},       {"magenta", {200, 50, 140}}};

}  // namespace

std::string name_of(const Lab& colour) {
  const char* best = names[0].name;
  double least = std::numeric_limits<double>::infinity();
  for (const Named& one : names) {
    const double far = difference(colour, lab_of(light_of(one.colour)));
    if (far < least) least = far, best = one.name;
  }
  return best;
}

}  // namespace unicursal::picture
