#include "geometry/box_tree.hpp"

#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <boost/iterator/function_output_iterator.hpp>

namespace enfilade {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using TreeEntry = std::pair<TreeBox, std::uint32_t>;

TreeBox tree_box(const Box& b, double grow) {
  return {{b.lo.x - grow, b.lo.y - grow, b.lo.z - grow},
          {b.hi.x + grow, b.hi.y + grow, b.hi.z + grow}};
}

/// Fewer boxes than this are looked through one by one, which is faster.
constexpr std::size_t few = 32;

}  // namespace

struct BoxTree::Impl {
  using Tree = bg::index::rtree<TreeEntry, bg::index::quadratic<16>>;

  explicit Impl(std::span<const Box> all) : boxes(all.begin(), all.end()) {
    if (boxes.size() >= few) grow();
  }
  void grow() {
    std::vector<TreeEntry> entries;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      entries.emplace_back(tree_box(boxes[i], 0.0), i);
    tree = Tree(entries.begin(), entries.end());
  }

  std::vector<Box> boxes;
  Tree tree;  ///< of all boxes, unless there are few
};

BoxTree::BoxTree(std::span<const Box> boxes) : impl_(std::make_unique<Impl>(boxes)) {}

BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

void BoxTree::add(const Box& box) {
  impl_->boxes.push_back(box);
  const std::size_t count = impl_->boxes.size();
  if (count == few) impl_->grow();
  if (count > few) impl_->tree.insert({tree_box(box, 0.0), static_cast<std::uint32_t>(count - 1)});
}

std::vector<std::uint32_t> BoxTree::touching(const Box& box, double margin_m) const {
  std::vector<std::uint32_t> found;
  if (impl_->boxes.size() < few) {
    for (std::uint32_t i = 0; i < impl_->boxes.size(); ++i) {
      if (impl_->boxes[i].overlaps(box, margin_m)) found.push_back(i);
    }
    return found;
  }
  found.reserve(few);
  const auto take = [&](const TreeEntry& entry) { found.push_back(entry.second); };
  impl_->tree.query(bg::index::intersects(tree_box(box, margin_m)),
                    boost::make_function_output_iterator(take));
  std::sort(found.begin(), found.end());  // the tree's own order is nobody's business
  return found;
}

std::vector<std::uint32_t> BoxTree::nearest(const Vec3& p, std::size_t count) const {
  std::vector<std::pair<double, std::uint32_t>> by_distance;
  const auto take = [&](std::uint32_t i) {
    const Box& box = impl_->boxes[i];
    by_distance.emplace_back(glm::distance(p, glm::clamp(p, box.lo, box.hi)), i);
  };
  if (impl_->boxes.size() < few) {
    for (std::uint32_t i = 0; i < impl_->boxes.size(); ++i) take(i);
  } else {
    const auto near = bg::index::nearest(TreePoint(p.x, p.y, p.z), static_cast<unsigned>(count));
    for (auto it = impl_->tree.qbegin(near); it != impl_->tree.qend(); ++it) take(it->second);
  }
  std::sort(by_distance.begin(), by_distance.end());
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < std::min(count, by_distance.size()); ++i)
    found.push_back(by_distance[i].second);
  return found;
}

}  // namespace enfilade
