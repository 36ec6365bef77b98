#include "core/drawing/contours.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace unicursal::core {
namespace {

using Cell = std::pair<long, long>;

Cell cell_of(const Vec2& p) {
  return {std::lround(std::floor(p.x() / joining_distance)),
          std::lround(std::floor(p.y() / joining_distance))};
}

/// The loose ends of lines, found by place.
class Ends {
 public:
  explicit Ends(const std::vector<const Subpath*>& lines) : lines_(lines), used_(lines.size(), false) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      cells_.emplace(cell_of(lines[i]->points.front()), i);
      cells_.emplace(cell_of(lines[i]->points.back()), i);
    }
  }

  bool used(std::size_t line) const { return used_[line]; }
  void use(std::size_t line) { used_[line] = true; }

  /// The nearest line that begins or ends at `p`.
  std::optional<std::size_t> at(const Vec2& p) const {
    std::optional<std::size_t> best;
    double nearest = joining_distance;
    const auto [x, y] = cell_of(p);
    for (long dx = -1; dx <= 1; ++dx) {
      for (long dy = -1; dy <= 1; ++dy) {
        const auto [from, to] = cells_.equal_range({x + dx, y + dy});
        for (auto entry = from; entry != to; ++entry) {
          if (used_[entry->second]) continue;
          const Ring& points = lines_[entry->second]->points;
          const double distance = std::min((points.front() - p).norm(), (points.back() - p).norm());
          if (distance < nearest || (distance == nearest && !best)) best = entry->second, nearest = distance;
        }
      }
    }
    return best;
  }

 private:
  const std::vector<const Subpath*>& lines_;
  std::vector<bool> used_;
  std::multimap<Cell, std::size_t> cells_;
};

void append(Ring& chain, const Ring& line) {
  const bool forwards = (line.front() - chain.back()).norm() <= (line.back() - chain.back()).norm();
  forwards ? chain.insert(chain.end(), line.begin(), line.end())
           : chain.insert(chain.end(), line.rbegin(), line.rend());
}

bool meets_itself(const Ring& chain) {
  return chain.size() > 2 && (chain.front() - chain.back()).norm() <= joining_distance;
}

}  // namespace

Enclosed enclosed_by(const std::vector<Subpath>& lines) {
  Enclosed result;
  std::vector<Ring> rings;
  std::vector<const Subpath*> open;
  for (const Subpath& line : lines) {
    if (line.points.empty()) continue;
    if (line.closed || meets_itself(line.points)) {
      if (line.points.size() > 2) rings.push_back(line.points);
    } else {
      open.push_back(&line);
    }
  }
  Ends ends(open);
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (ends.used(i)) continue;
    ends.use(i);
    Ring chain = open[i]->points;
    std::size_t joined = 1;
    while (!meets_itself(chain)) {
      const auto next = ends.at(chain.back());
      if (!next) break;
      ends.use(*next);
      append(chain, open[*next]->points);
      ++joined;
    }
    if (meets_itself(chain)) {
      rings.push_back(std::move(chain));
    } else {
      result.open += joined;
    }
  }
  result.region = enclosed(rings, FillRule::even_odd);
  return result;
}

}  // namespace unicursal::core
