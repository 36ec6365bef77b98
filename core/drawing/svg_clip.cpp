// The part of Scene that cuts: clip paths (SVG 1.1, section 14.3) and masks (14.4).
#include <array>

#include "core/drawing/svg_scene.hpp"
#include "core/drawing/svg_transform.hpp"
#include "core/text/malformed.hpp"

namespace unicursal::core {
namespace {

constexpr double lets_through = 0.5;  ///< of a mask's light, from which on what lies below is kept
constexpr double sharp = 0.02;        ///< masks that differ from 0 and 1 by no more are not called gradual

/// Maps shares of a box to user units.
Eigen::Affine2d shares_of(const Box& box) {
  return Eigen::Translation2d(box.min) * Eigen::Scaling(box.size());
}

bool by_box(const pugi::xml_node& node, const char* attribute, bool otherwise) {
  const auto units = node.attribute(attribute);
  return units ? std::string_view(units.value()) == "objectBoundingBox" : otherwise;
}

std::array<double, 6> numbers_of(const Eigen::Affine2d& map) {
  const auto& m = map.matrix();
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2)};
}

Region union_of(const std::vector<Piece>& pieces) {
  std::vector<const Region*> regions;
  for (const Piece& piece : pieces) regions.push_back(&piece.region);
  return unite(regions);
}

}  // namespace

void Scene::narrow(Context& context, Region by) const {
  if (context.clip) by = intersect(*context.clip, by);
  context.clip = std::make_shared<const Region>(std::move(by));
}

void Scene::cut(const pugi::xml_node& node, Entered& entered) {
  const auto target = [&](const std::string& id, const char* kind) {
    const pugi::xml_node found = document_.by_id(id);
    if (document_.name(found) != kind) {
      notes_.add(Finding::missing_target, document_.where(node));
      return pugi::xml_node{};
    }
    if (in_use(found)) {
      notes_.add(Finding::circle_of_links, document_.where(node));
      return pugi::xml_node{};
    }
    return found;
  };
  if (!entered.style.clip_path.empty()) {
    if (const pugi::xml_node clip = target(entered.style.clip_path, "clipPath"))
      narrow(entered.context, *clip_region(clip, node, entered));
  }
  if (!entered.style.mask.empty()) {
    if (const pugi::xml_node mask = target(entered.style.mask, "mask"))
      narrow(entered.context, mask_region(mask, node, entered));
  }
}

/// A clip path of a clip path, and a mask of a mask, act in the frame of the element that is cut.
Region Scene::cut_further(Region region, const pugi::xml_node& node, const Entered& entered,
                          const std::string& clip_path, const std::string& mask) {
  Entered same = entered;
  same.style.clip_path = clip_path;
  same.style.mask = mask;
  same.context.clip = std::make_shared<const Region>(std::move(region));
  cut(node, same);
  return *same.context.clip;
}

std::shared_ptr<const Region> Scene::clip_region(const pugi::xml_node& clip, const pugi::xml_node& node,
                                                 const Entered& entered) {
  const bool shares = by_box(clip, "clipPathUnits", false);
  const auto key =
      std::pair(static_cast<const void*>(clip.internal_object()), numbers_of(entered.context.to_part));
  if (const auto known = clips_.find(key); !shares && known != clips_.end()) return known->second;
  spend(clip, price_of_a_cut, 0);
  Entered inner{styled(clip, style_around(clip), 0, source()), {}};
  inner.context.style = inner.style;
  inner.context.viewport = entered.context.viewport;
  inner.context.depth = entered.context.depth + 1;
  inner.context.to_part = entered.context.to_part * own_transform(clip, inner);
  if (shares) inner.context.to_part = inner.context.to_part * shares_of(box_of(node, entered));
  Region region;
  const Opened opened(open_, clip);
  if (inner.context.to_part.linear().determinant() != 0) {
    const Purpose before = std::exchange(purpose_, Purpose::clip);
    std::vector<Piece> outer = std::exchange(pieces_, {});
    children(clip, inner.context);
    region = union_of(pieces_);
    pieces_ = std::move(outer);
    purpose_ = before;
  }
  if (!inner.style.clip_path.empty())
    region = cut_further(std::move(region), node, entered, inner.style.clip_path, {});
  auto result = std::make_shared<const Region>(std::move(region));
  if (!shares && inner.style.clip_path.empty()) clips_.emplace(key, result);
  return result;
}

Region Scene::mask_region(const pugi::xml_node& mask, const pugi::xml_node& node, const Entered& entered) {
  spend(mask, price_of_a_cut, 0);
  Entered inner{styled(mask, style_around(mask), 0, source()), {}};
  inner.context.style = inner.style;
  inner.context.viewport = entered.context.viewport;
  inner.context.depth = entered.context.depth + 1;
  const Box box = box_of(node, entered);
  const bool frame_shares = by_box(mask, "maskUnits", true);
  const Vec2 whole = frame_shares ? Vec2(1, 1) : entered.context.viewport;
  const auto side = [&](const char* name, double all, double otherwise) {
    return length_or(mask, inner, name, all, otherwise * all);
  };
  const Vec2 corner(side("x", whole.x(), -0.1), side("y", whole.y(), -0.1));
  const Vec2 size(side("width", whole.x(), 1.2), side("height", whole.y(), 1.2));
  if (!(size.minCoeff() > 0)) return {};
  const Eigen::Affine2d& to_part = entered.context.to_part;
  const Eigen::Affine2d frame_map = frame_shares ? to_part * shares_of(box) : to_part;
  const Region frame = mapped_box(frame_map, {corner, corner + size});
  inner.context.to_part = to_part;
  if (by_box(mask, "maskContentUnits", false)) inner.context.to_part = to_part * shares_of(box);
  if (inner.context.to_part.linear().determinant() == 0) return {};

  const Opened opened(open_, mask);
  const Purpose before = std::exchange(purpose_, Purpose::paint);
  std::vector<Piece> outer = std::exchange(pieces_, {});
  const std::size_t contours = contours_.size();
  children(mask, inner.context);
  const std::vector<Piece> painted = std::exchange(pieces_, std::move(outer));
  contours_.resize(contours);
  purpose_ = before;
  bool soft = false;
  Region region;
  for (const Piece& piece : painted) {
    const double light = inner.style.mask_by_alpha ? piece.alpha : piece.alpha * piece.light;
    soft = soft || !piece.even || (light > sharp && light < 1 - sharp);
    if (light >= lets_through) {
      region = unite(region, piece.region);
    } else if (piece.alpha >= lets_through && !inner.style.mask_by_alpha) {
      region = subtract(region, piece.region);
    }
  }
  region = intersect(region, frame);
  if (soft) notes_.add(Finding::soft_mask, document_.where(node));
  if (!inner.style.mask.empty()) region = cut_further(std::move(region), node, entered, {}, inner.style.mask);
  return region;
}

}  // namespace unicursal::core
