// Drawings as text for the tests of core/drawing.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/drawing/svg_reader.hpp"
#include "core/error.hpp"
#include "tests/core/model/model_support.hpp"

namespace unicursal::core {

struct Reading {
  std::vector<Shape> shapes;
  std::vector<std::string> warnings;
};

inline Reading read(const std::string& text, const DrawingOptions& options = {}) {
  const TempFolder folder;
  Warnings warnings;
  Reading result;
  result.shapes = read_svg(folder.write("drawing.svg", text), warnings, options).shapes;
  result.warnings = warnings.sentences();
  return result;
}

/// The text of the refusal; empty if it is read.
inline std::string refusal_of(const std::string& text) {
  try {
    read(text);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

/// The area of each colour that is seen, mm².
inline std::map<std::string, double> seen_areas(const std::vector<Shape>& shapes) {
  std::map<std::string, double> areas;
  Region covered;
  for (auto shape = shapes.rbegin(); shape != shapes.rend(); ++shape) {
    areas[shape->fill] += area(subtract(shape->region, covered));
    covered = unite(covered, shape->region);
  }
  return areas;
}

/// The area of all shapes together, on a page of 100 mm × 80 mm whose user unit is 1 mm.
inline double area_of(const std::string& elements) {
  double sum = 0;
  for (const auto& [colour, area] : seen_areas(read(drawing(elements)).shapes)) sum += area;
  return sum;
}

inline std::string notes_of(const std::string& elements) {
  std::string text;
  for (const std::string& sentence : read(drawing(elements)).warnings) text += sentence + "\n";
  return text;
}

}  // namespace unicursal::core
