#include "core/stripes/phase.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/numeric/random.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double border_band = 1.0;    ///< bead widths; nodes this near to a border feel it
constexpr double border_weight = 0.5;  ///< of a node at a border that strands run along, in edges of the grid
constexpr double border_power = 8;     ///< of the cosine between strands and border
constexpr double inertia = 0.05;       ///< weight of the last ψ in each solve
constexpr int first_rounds = 12;  ///< solves for the start, in which only the length of the whole is kept
constexpr double most_at_once = 3'000;  ///< nodes that one factor serves; of more, every second is left out
constexpr int sweeps = 30;              ///< of relaxation, on each finer level
constexpr int rounds = 20;              ///< solves with |ψ| = 1 in between

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// ψ_q = e^{i growth} ψ_p, or its conjugate if `sign` is −1: how the phase continues from node p to node q.
struct Transport {
  double growth = 0, sign = 1;
  double weight = 0;  ///< 0 if the way leaves the grid
};

/// Every stride-th node of a grid in both directions, and how the phase continues from each to its
/// neighbours.
class Level {
 public:
  Level(const StripeGrid& grid, std::ptrdiff_t stride, double per_mm)
      : grid_(grid), stride_(stride), per_mm_(per_mm) {
    index_.assign(grid.size(), -1);
    for (std::ptrdiff_t row = 0; row < grid.rows; row += stride) {
      for (std::ptrdiff_t column = 0; column < grid.columns; column += stride) {
        const std::ptrdiff_t node = grid.node(column, row);
        if (node < 0) continue;
        index_[static_cast<std::size_t>(node)] = static_cast<std::ptrdiff_t>(nodes_.size());
        nodes_.push_back({column, row, static_cast<std::size_t>(node)});
      }
    }
  }

  struct Node {
    std::ptrdiff_t column, row;
    std::size_t of_grid;
  };
  const std::vector<Node>& nodes() const { return nodes_; }

  /// Calls visit(p, q, transport) once for each pair of neighbours, diagonal ones too.
  template <typename Visit>
  void each_edge(Visit visit) const {
    struct Step {
      std::ptrdiff_t columns, rows;
      double weight;
    };
    for (const Step& step : {Step{1, 0, 1}, Step{0, 1, 1}, Step{1, 1, 0.5}, Step{-1, 1, 0.5}}) {
      for (std::size_t p = 0; p < nodes_.size(); ++p) {
        const std::ptrdiff_t end =
            grid_.node(nodes_[p].column + stride_ * step.columns, nodes_[p].row + stride_ * step.rows);
        if (end < 0) continue;
        Transport way = along(nodes_[p], step.columns, step.rows);
        way.weight *= step.weight;
        if (way.weight > 0) visit(p, static_cast<std::size_t>(index_[static_cast<std::size_t>(end)]), way);
      }
    }
  }

 private:
  Transport along(const Node& from, std::ptrdiff_t columns, std::ptrdiff_t rows) const {
    Transport way{0, 1, 1};
    std::size_t here = from.of_grid;
    for (std::ptrdiff_t k = 1; k <= stride_; ++k) {
      const std::ptrdiff_t node = grid_.node(from.column + k * columns, from.row + k * rows);
      if (node < 0) return {};
      const auto next = static_cast<std::size_t>(node);
      const double alike = grid_.normals[here].dot(grid_.normals[next]), sign = alike < 0 ? -1 : 1;
      way.growth += way.sign * per_mm_ / 2 *
                    (grid_.normals[here] + sign * grid_.normals[next])
                        .dot(grid_.positions[next] - grid_.positions[here]);
      way.sign *= sign;
      way.weight *= std::abs(alike);
      here = next;
    }
    return way;
  }

  const StripeGrid& grid_;
  std::ptrdiff_t stride_;
  double per_mm_;
  std::vector<Node> nodes_;
  std::vector<std::ptrdiff_t> index_;  ///< per node of the grid: its number here, or −1
};

/// What borders ask of a node: the value of ψ there, times a weight.
struct Pull {
  Vec2 psi{0, 0};
  double weight = 0;
};

std::vector<Pull> pulls_of(const StripeGrid& grid, const BorderIndex& border, double w) {
  std::vector<Pull> pulls(grid.size());
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const NearBorder near = near_border(border, grid.positions[k], border_band * w);
    if (near.distance >= border_band * w) continue;
    const double side = border.contains(grid.positions[k]) ? 1 : -1;
    const double facing = side * grid.normals[k].dot(near.away);
    const double angle = std::numbers::pi / w * side * near.distance * (facing > 0 ? 1 : -1);
    pulls[k].weight = border_weight * std::pow(std::abs(facing), border_power);
    pulls[k].psi = pulls[k].weight * Vec2(std::cos(angle), std::sin(angle));
  }
  return pulls;
}

void normalise(Vec2& psi) {
  const double modulus = psi.norm();
  if (modulus > 0) psi /= modulus;
}

/// Solves for all nodes of a level at once: the least Σ ‖ψ_q − T ψ_p‖² with |ψ| = 1.
void solve_at_once(const Level& level, const std::vector<Pull>& pulls, std::vector<Vec2>& psi,
                   const MayContinue& may_continue) {
  const auto nodes = static_cast<Eigen::Index>(level.nodes().size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(28 * level.nodes().size());
  const auto add = [&](Eigen::Index row, Eigen::Index column, double value) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  };
  level.each_edge([&](std::size_t from, std::size_t to, const Transport& way) {
    const double c = std::cos(way.growth), s = std::sin(way.growth);
    const double transport[2][2] = {{c, -s}, {way.sign * s, way.sign * c}};
    const auto p = static_cast<Eigen::Index>(2 * from), q = static_cast<Eigen::Index>(2 * to);
    for (Eigen::Index row = 0; row < 2; ++row) {
      add(p + row, p + row, way.weight);
      add(q + row, q + row, way.weight);
      for (Eigen::Index column = 0; column < 2; ++column) {
        const double value = -way.weight * transport[row][column];
        add(q + row, p + column, value);
        add(p + column, q + row, value);
      }
    }
  });
  Vector pull = Vector::Zero(2 * nodes), solution(2 * nodes);
  Random random(0);  // the start matters only where no border fixes the phase
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const Pull& asked = pulls[level.nodes()[static_cast<std::size_t>(i)].of_grid];
    pull.segment<2>(2 * i) = asked.psi;
    for (Eigen::Index k = 2 * i; k < 2 * i + 2; ++k) {
      add(k, k, asked.weight + inertia);
      solution[k] = random.uniform(-0.5, 0.5);
    }
  }
  Matrix matrix(2 * nodes, 2 * nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  stop_point();
  const Eigen::SimplicialLDLT<Matrix> factor(matrix);
  for (int round = 0; round < first_rounds + rounds; ++round) {
    if (may_continue && !may_continue()) break;
    solution = factor.solve(Vector(inertia * solution + pull));
    if (round < first_rounds) {
      solution *= std::sqrt(static_cast<double>(nodes)) / std::max(solution.norm(), 1e-300);
    } else {
      for (Eigen::Index i = 0; i < nodes; ++i) {
        const double modulus = solution.segment<2>(2 * i).norm();
        if (modulus > 0) solution.segment<2>(2 * i) /= modulus;
      }
    }
  }
  for (Eigen::Index i = 0; i < nodes; ++i)
    psi[level.nodes()[static_cast<std::size_t>(i)].of_grid] = solution.segment<2>(2 * i);
}

/// Gives values to the nodes of a level that have none yet, and lets all give way to their neighbours.
class Relaxation {
 public:
  Relaxation(const Level& level, const std::vector<Pull>& pulls, std::vector<Vec2>& psi)
      : level_(level), pulls_(pulls), psi_(psi), start_(level.nodes().size() + 1, 0) {
    level.each_edge(
        [&](std::size_t p, std::size_t q, const Transport&) { ++start_[p + 1], ++start_[q + 1]; });
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    ways_.resize(start_.back());
    std::vector<std::size_t> next = start_;
    level.each_edge([&](std::size_t p, std::size_t q, const Transport& way) {
      const double c = way.weight * std::cos(way.growth), s = way.weight * std::sin(way.growth);
      ways_[next[q]++] = {level.nodes()[p].of_grid, c, s, way.sign};
      // The way back: ψ_p = e^{−i growth} ψ_q, or e^{−i growth} times the conjugate of ψ_q.
      ways_[next[p]++] = {level.nodes()[q].of_grid, c, way.sign > 0 ? -s : s, way.sign};
    });
  }

  void fill() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < level_.nodes().size(); ++i) {
        Vec2& psi = psi_[level_.nodes()[i].of_grid];
        if (psi != Vec2(0, 0)) continue;
        psi = asked(i);
        changed = changed || psi != Vec2(0, 0);
      }
    }
  }

  void sweep() {
    for (std::size_t i = 0; i < level_.nodes().size(); ++i) psi_[level_.nodes()[i].of_grid] = asked(i);
  }

 private:
  struct Way {
    std::size_t from;
    double cosine, sine, sign;  ///< ψ = (cosine + i sine) ψ_from, or its conjugate
  };

  Vec2 asked(std::size_t i) const {
    Vec2 sum = pulls_[level_.nodes()[i].of_grid].psi;
    for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
      const Way& way = ways_[k];
      const Vec2& psi = psi_[way.from];
      sum += Vec2(way.cosine * psi.x() - way.sine * psi.y(),
                  way.sign * (way.sine * psi.x() + way.cosine * psi.y()));
    }
    normalise(sum);
    return sum;
  }

  const Level& level_;
  const std::vector<Pull>& pulls_;
  std::vector<Vec2>& psi_;  ///< per node of the grid
  std::vector<std::size_t> start_;
  std::vector<Way> ways_;
};

}  // namespace

Phase::Phase(StripeGrid grid, std::vector<double> angles, double bead_width)
    : grid_(std::move(grid)), angles_(std::move(angles)), per_mm_(std::numbers::pi / bead_width) {}

double Phase::cosine(const Vec2& point) const {
  const Vec2 at = (point - grid_.origin) / grid_.pitch;
  const auto column = static_cast<std::ptrdiff_t>(std::floor(at.x()));
  const auto row = static_cast<std::ptrdiff_t>(std::floor(at.y()));
  const Vec2 part = at - Vec2(static_cast<double>(column), static_cast<double>(row));
  double sum = 0, total = 0;
  for (std::ptrdiff_t right = 0; right < 2; ++right) {
    for (std::ptrdiff_t up = 0; up < 2; ++up) {
      const std::ptrdiff_t node = grid_.node(column + right, row + up);
      if (node < 0) continue;
      const auto k = static_cast<std::size_t>(node);
      const double weight = (right ? part.x() : 1 - part.x()) * (up ? part.y() : 1 - part.y()) + 1e-6;
      sum += weight * std::cos(angles_[k] + per_mm_ * grid_.normals[k].dot(point - grid_.positions[k]));
      total += weight;
    }
  }
  return total > 0 ? sum / total : 1.0;
}

Phase find_phase(StripeGrid grid, const BorderIndex& border, double bead_width,
                 const MayContinue& may_continue) {
  const double per_mm = std::numbers::pi / bead_width;
  const std::vector<Pull> pulls = pulls_of(grid, border, bead_width);
  std::vector<Vec2> psi(grid.size(), Vec2(0, 0));
  std::ptrdiff_t stride = 1;
  while (static_cast<double>(grid.size()) > most_at_once * static_cast<double>(stride * stride)) stride *= 2;
  solve_at_once(Level(grid, stride, per_mm), pulls, psi, may_continue);
  while (stride > 1) {
    stride /= 2;
    const Level level(grid, stride, per_mm);
    Relaxation relaxation(level, pulls, psi);
    relaxation.fill();
    for (int k = 0; k < sweeps; ++k) {
      if (may_continue && !may_continue()) break;
      relaxation.sweep();
    }
  }
  std::vector<double> angles(grid.size());
  for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = std::atan2(psi[i].y(), psi[i].x());
  return {std::move(grid), std::move(angles), bead_width};
}

}  // namespace unicursal::core
