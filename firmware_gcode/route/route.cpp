#include "firmware_gcode/route/route.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "firmware_gcode/route/island_order.hpp"

namespace unicursal::gcode {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Weights, in mm³ of plastic in the wrong mixture.
constexpr double travel_weight = 1000;  ///< outweighs everything else
constexpr double way_weight = 0.002;    ///< per mm
constexpr double seam_weight = 0.3;     ///< of a fully visible seam
constexpr double hidden_depth = 2.5;    ///< bead widths inside the outline at which a seam is invisible
constexpr double notch_discount = 0.5;  ///< of the weight of a seam in the sharpest notches of the outline
constexpr double aligned_reach = 5;     ///< mm from the target at which a seam counts as fully visible
constexpr double cell =
    2;  ///< mm; side of a square; the best end of a square represents all others as the start of a travel

double mean_width(const core::BeadPath& path) {
  return path.total_area() / path.total_length();
}

/// State k of a path: it begins at vertex k/2, forwards or (odd k) backwards.
struct Beginning {
  std::size_t vertex;
  bool reversed;
};

Beginning beginning(std::size_t k) {
  return {k / 2, k % 2 == 1};
}

/// One path of the chain with the costs of its states.
struct Node {
  std::size_t layer, path;  ///< indices in the window and in the layer
  const core::BeadPath* beads;
  double width;
  std::vector<double> own;        ///< cost of each state alone
  std::vector<double> least;      ///< cost of the best chain that ends in each state
  std::vector<std::size_t> from;  ///< the previous state in that chain

  std::size_t before(std::size_t vertex) const { return (vertex + beads->size() - 1) % beads->size(); }
  std::size_t first_zone(std::size_t k) const {
    const auto [vertex, reversed] = beginning(k);
    return beads->beads[reversed ? before(vertex) : vertex].zone;
  }
  std::size_t last_zone(std::size_t k) const {
    const auto [vertex, reversed] = beginning(k);
    return beads->beads[reversed ? vertex : before(vertex)].zone;
  }
  const core::Vec2& place(std::size_t k) const { return beads->start(k / 2); }
};

std::uint64_t cell_of(const core::Vec2& p, double size) {
  const auto x = static_cast<std::int64_t>(std::floor(p.x() / size)),
             y = static_cast<std::int64_t>(std::floor(p.y() / size));
  return (static_cast<std::uint64_t>(x) << 32) ^ static_cast<std::uint32_t>(y);
}

/// A grid of squares over the vertices of a path; each square keeps the order of its vertices.
class VertexGrid {
 public:
  /// `reach`: radius of the search for neighbours, mm.
  VertexGrid(const core::BeadPath& path, double reach)
      : path_(path), reach_(reach), square_(reach), least_(path.start(0)) {
    core::Vec2 greatest = least_;
    for (const core::Bead& bead : path.beads) {
      least_ = least_.cwiseMin(bead.position);
      greatest = greatest.cwiseMax(bead.position);
    }
    square_ = std::max(reach, (greatest - least_).maxCoeff() / most_columns);
    columns_ = column(greatest.x(), least_.x()) + 1;
    rows_ = column(greatest.y(), least_.y()) + 1;
    begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (std::size_t v = 0; v < path.size(); ++v) ++begin_[square_of(path.start(v)) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    vertices_.resize(path.size());
    for (std::size_t v = 0; v < path.size(); ++v) {
      vertices_[next[square_of(path.start(v))]++] = static_cast<std::uint32_t>(v);
    }
  }

  /// Calls use(vertex) for all vertices within the reach of `p`.
  template <typename Use>
  void for_each_near(const core::Vec2& p, Use&& use) const {
    const std::int64_t x = column(p.x(), least_.x()), y = column(p.y(), least_.y());
    for (std::int64_t cx = std::max<std::int64_t>(0, x - 1); cx <= std::min(columns_ - 1, x + 1); ++cx) {
      for (std::int64_t cy = std::max<std::int64_t>(0, y - 1); cy <= std::min(rows_ - 1, y + 1); ++cy) {
        const auto square = static_cast<std::size_t>(cx * rows_ + cy);
        for (std::uint32_t i = begin_[square]; i < begin_[square + 1]; ++i) {
          if ((path_.start(vertices_[i]) - p).norm() <= reach_) use(vertices_[i]);
        }
      }
    }
  }

 private:
  static constexpr double most_columns = 1024;

  std::int64_t column(double at, double least) const {
    return static_cast<std::int64_t>(std::floor(at / square_)) -
           static_cast<std::int64_t>(std::floor(least / square_));
  }
  std::size_t square_of(const core::Vec2& p) const {
    return static_cast<std::size_t>(column(p.x(), least_.x()) * rows_ + column(p.y(), least_.y()));
  }

  const core::BeadPath& path_;
  double reach_;
  double square_;  ///< side of a square, mm; at least the reach
  core::Vec2 least_;
  std::int64_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> begin_;  ///< of each square's vertices; the last entry is the end
  std::vector<std::uint32_t> vertices_;
};

/// The visibility of a seam: 0 invisible, 1 most visible.
class SeamLook {
 public:
  SeamLook(const PlacedLayer& layer, Seam seam, std::optional<core::Vec2> aim) : seam_(seam), aim_(aim) {
    for (const core::Polygon& outline : layer.outlines) {
      index(outline.outer);
      for (const core::Ring& hole : outline.holes) index(hole);
    }
  }

  double operator()(const core::Vec2& p, double width) const {
    if (seam_ == Seam::nearest) return 0;
    if (seam_ == Seam::hidden) return shown(p, width);
    return aim_ ? std::min(1.0, (p - *aim_).norm() / aligned_reach) : 0;
  }

 private:
  static constexpr double bucket = 3;  ///< mm

  struct Corner {
    core::Vec2 from, at, to;
  };

  void index(const core::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Corner corner{ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]};
      const core::Vec2 step = corner.to - corner.at;
      const auto parts = static_cast<std::size_t>(step.norm() / (bucket / 2)) + 1;
      std::uint64_t last = 0;
      for (std::size_t k = 0; k <= parts; ++k) {
        const std::uint64_t key =
            cell_of(corner.at + step * (static_cast<double>(k) / static_cast<double>(parts)), bucket);
        if (k > 0 && key == last) continue;
        corners_[last = key].push_back(corner);
      }
    }
  }

  /// By the depth below the outline; lower on the outline where it turns inwards.
  double shown(const core::Vec2& p, double width) const {
    const double deep = hidden_depth * width;
    double depth = deep, notch = 0;
    const int reach = static_cast<int>(std::ceil(deep / bucket));
    for (int dx = -reach; dx <= reach; ++dx) {
      for (int dy = -reach; dy <= reach; ++dy) {
        const auto found = corners_.find(cell_of(p + core::Vec2(dx * bucket, dy * bucket), bucket));
        if (found == corners_.end()) continue;
        for (const Corner& c : found->second) {
          depth = std::min(depth, core::distance_to_segment(p, c.at, c.to));
          if ((p - c.at).norm() < width) notch = std::max(notch, -sine(c));
        }
      }
    }
    return (1 - depth / deep) * (1 - notch_discount * notch);
  }

  /// The sine of the turn at a corner: negative where the outline (counter-clockwise; holes clockwise) turns
  /// into the part.
  static double sine(const Corner& c) {
    const core::Vec2 a = c.at - c.from, b = c.to - c.at;
    const double length = a.norm() * b.norm();
    return length > 0 ? core::cross(a, b) / length : 0;
  }

  Seam seam_;
  std::optional<core::Vec2> aim_;
  std::unordered_map<std::uint64_t, std::vector<Corner>> corners_;
};

/// A different place in every layer, the same in every run (golden angle).
core::Vec2 scattered_aim(const PlacedLayer& layer, const core::BeadPath& path) {
  constexpr double golden = 0.6180339887498949;
  const double part = std::fmod(golden * static_cast<double>(layer.index + 1), 1.0);
  return path.start(static_cast<std::size_t>(part * static_cast<double>(path.size())));
}

}  // namespace

std::size_t bead_of(const core::BeadPath& path, const Traversal& leg, std::size_t k) {
  return leg.reversed ? (leg.start + path.size() - 1 - k) % path.size() : (leg.start + k) % path.size();
}

core::Vec2 bead_end(const core::BeadPath& path, const Traversal& leg, std::size_t k) {
  const std::size_t bead = bead_of(path, leg, k);
  return leg.reversed ? path.start(bead) : path.end(bead);
}

bool is_printable(const core::BeadPath& path) {
  return path.size() >= 2 && path.total_length() > 0;
}

struct Route::State {
  explicit State(RouteOptions with) : options(std::move(with)) {}

  /// A layer with the costs of its states by path, computed on demand.
  struct Waiting {
    PlacedLayer layer;
    std::vector<std::vector<double>> own;
  };

  std::vector<Node> chain();
  const std::vector<double>& own_costs(const Node& node);
  void begin(Node& node) const;
  void follow(Node& node, const Node& before) const;
  void travel(Node& node, const Node& before) const;
  double step_cost(const Node& node, std::size_t k, const core::Vec2& from, std::size_t zone) const;
  RoutedLayer decide();

  RouteOptions options;
  std::deque<Waiting> waiting;
  std::size_t decided = 0;  ///< layers
  bool ended = false;
  std::optional<core::BeadPath> last_path;  ///< of the final layers
  core::Vec2 here{0, 0};                    ///< end of the last path
  std::size_t here_zone = 0;                ///< zone of that end
  std::optional<core::Vec2> aim;            ///< of aligned seams
};

/// All paths of the waiting layers in printing order.
std::vector<Node> Route::State::chain() {
  std::vector<Node> nodes;
  const auto printable = [&](std::size_t l) {
    std::vector<const core::BeadPath*> paths;
    for (; l < waiting.size(); ++l) {
      for (const core::BeadPath& path : waiting[l].layer.paths) {
        if (is_printable(path)) paths.push_back(&path);
      }
      if (!paths.empty()) break;
    }
    return paths;
  };
  const core::BeadPath* before = last_path ? &*last_path : nullptr;
  for (std::size_t l = 0; l < waiting.size(); ++l) {
    std::vector<const core::BeadPath*> paths;
    for (const core::BeadPath& path : waiting[l].layer.paths) {
      if (is_printable(path)) paths.push_back(&path);
    }
    for (const std::size_t i : island_order(paths, before, printable(l + 1))) {
      const auto index = static_cast<std::size_t>(paths[i] - waiting[l].layer.paths.data());
      nodes.push_back({l, index, paths[i], mean_width(*paths[i]), {}, {}, {}});
      before = paths[i];
    }
  }
  return nodes;
}

/// The visibility of the seam, minus the change that a beginning on a border saves.
const std::vector<double>& Route::State::own_costs(const Node& node) {
  std::vector<double>& own = waiting[node.layer].own[node.path];
  if (!own.empty()) return own;
  const PlacedLayer& layer = waiting[node.layer].layer;
  const std::optional<core::Vec2> target =
      options.seam == Seam::scattered ? std::optional(scattered_aim(layer, *node.beads)) : aim;
  const SeamLook look(layer, options.seam, target);
  own.resize(2 * node.beads->size());
  for (std::size_t v = 0; v < node.beads->size(); ++v) {
    const double seam = seam_weight * look(node.beads->start(v), node.width);
    for (std::size_t k = 2 * v; k <= 2 * v + 1; ++k) {
      const std::size_t last = node.last_zone(k), first = node.first_zone(k);
      own[k] = seam - (last == first ? 0 : options.change_cost(last, first));
    }
  }
  return own;
}

double Route::State::step_cost(const Node& node, std::size_t k, const core::Vec2& from,
                               std::size_t zone) const {
  const double way = (node.place(k) - from).norm();
  const std::size_t next = node.first_zone(k);
  return way_weight * way + (way > travel_widths * node.width ? travel_weight : 0) +
         (zone == next ? 0 : options.change_cost(zone, next));
}

/// The costs of the first path of the chain. It follows the last final path, if there is one.
void Route::State::begin(Node& node) const {
  node.least = node.own;
  node.from.assign(node.own.size(), 0);
  if (!last_path) return;
  for (std::size_t k = 0; k < node.own.size(); ++k) node.least[k] += step_cost(node, k, here, here_zone);
}

/// Examines every pair of neighbouring vertices. This is repeated in all layers of the horizon for every
/// layer, so that work common to both directions is done once.
void Route::State::follow(Node& node, const Node& before) const {
  const std::size_t count = node.own.size();
  node.least.assign(count, infinite);
  node.from.assign(count, 0);
  const double reach = travel_widths * node.width;
  const VertexGrid near(*before.beads, reach);
  bool reached = false;
  const auto consider = [&](std::size_t k, std::size_t end) {
    const double cost =
        before.least[end] + node.own[k] + step_cost(node, k, before.place(end), before.last_zone(end));
    if (cost >= node.least[k]) return;
    node.least[k] = cost, node.from[k] = end;
    reached = true;
  };
  for (std::size_t k = 0; k < count; k += 2) {
    const bool alike = node.own[k] == node.own[k + 1] && node.first_zone(k) == node.first_zone(k + 1);
    near.for_each_near(node.place(k), [&](std::size_t vertex) {
      const std::size_t ahead = 2 * vertex, back = ahead + 1;
      const bool one_zone = before.last_zone(ahead) == before.last_zone(back);
      for (const std::size_t end : {ahead, back}) {
        const std::size_t other = end == ahead ? back : ahead;
        const bool beaten =
            end == ahead ? before.least[other] < before.least[end] : before.least[other] <= before.least[end];
        if (one_zone && beaten) continue;
        consider(k, end);
        if (!alike) consider(k + 1, end);
      }
    });
    if (alike) node.least[k + 1] = node.least[k], node.from[k + 1] = node.from[k];
  }
  if (!reached) travel(node, before);  // a travel never pays if another state needs none
}

/// Travels to every state from the best end in every square and zone.
void Route::State::travel(Node& node, const Node& before) const {
  std::map<std::pair<std::uint64_t, std::size_t>, std::size_t> far;
  for (std::size_t k = 0; k < before.own.size(); ++k) {
    const auto [best, added] = far.try_emplace({cell_of(before.place(k), cell), before.last_zone(k)}, k);
    if (!added && before.least[k] < before.least[best->second]) best->second = k;
  }
  for (std::size_t k = 0; k < node.own.size(); ++k) {
    for (const auto& [where, end] : far) {
      const double cost =
          before.least[end] + node.own[k] + step_cost(node, k, before.place(end), before.last_zone(end));
      if (cost < node.least[k]) node.least[k] = cost, node.from[k] = end;
    }
  }
}

RoutedLayer Route::State::decide() {
  std::vector<Node> nodes = chain();
  std::vector<std::size_t> states(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].own = own_costs(nodes[i]);
    if (i == 0)
      begin(nodes[i]);
    else
      follow(nodes[i], nodes[i - 1]);
  }
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const std::vector<double>& least = nodes[i].least;
    states[i] = i + 1 == nodes.size()
                    ? static_cast<std::size_t>(std::min_element(least.begin(), least.end()) - least.begin())
                    : nodes[i + 1].from[states[i + 1]];
  }
  RoutedLayer routed;
  for (std::size_t i = 0; i < nodes.size() && nodes[i].layer == 0; ++i) {
    const auto [vertex, reversed] = beginning(states[i]);
    routed.traversals.push_back({nodes[i].path, vertex, reversed});
    here = nodes[i].place(states[i]);
    here_zone = nodes[i].last_zone(states[i]);
    if (!aim && options.seam == Seam::aligned) {
      aim = here;
      for (Waiting& each : waiting) each.own.assign(each.own.size(), {});
    }
  }
  routed.layer = std::move(waiting.front().layer);
  waiting.pop_front();
  if (!routed.traversals.empty()) last_path = routed.layer.paths[routed.traversals.back().path];
  return routed;
}

Route::Route(RouteOptions options) : state_(std::make_unique<State>(std::move(options))) {}
Route::~Route() = default;
Route::Route(Route&&) noexcept = default;

void Route::add(PlacedLayer layer) {
  std::vector<std::vector<double>> own(layer.paths.size());
  state_->waiting.push_back({std::move(layer), std::move(own)});
}

void Route::end() {
  state_->ended = true;
}

std::vector<const PlacedLayer*> Route::waiting() const {
  std::vector<const PlacedLayer*> layers;
  for (const State::Waiting& each : state_->waiting) layers.push_back(&each.layer);
  return layers;
}

std::optional<RoutedLayer> Route::take() {
  std::size_t enough = std::max<std::size_t>(1, state_->options.horizon);
  if (state_->options.growing) enough = std::min(enough, 1 + (state_->decided + 1) / 2);
  if (state_->waiting.empty() || (!state_->ended && state_->waiting.size() < enough)) return std::nullopt;
  ++state_->decided;
  return state_->decide();
}

}  // namespace unicursal::gcode
