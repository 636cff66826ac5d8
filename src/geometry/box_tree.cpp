#include "geometry/box_tree.hpp"

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

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

std::vector<TreeEntry> entries_of(std::span<const Box> boxes) {
  std::vector<TreeEntry> entries;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) entries.emplace_back(tree_box(boxes[i], 0.0), i);
  return entries;
}

}  // namespace

struct BoxTree::Impl {
  explicit Impl(const std::vector<TreeEntry>& entries) : tree(entries.begin(), entries.end()) {}
  bg::index::rtree<TreeEntry, bg::index::rstar<16>> tree;
};

BoxTree::BoxTree(std::span<const Box> boxes) : impl_(std::make_unique<Impl>(entries_of(boxes))) {}

BoxTree::~BoxTree() = default;

std::vector<std::uint32_t> BoxTree::touching(const Box& box, double margin_m) const {
  std::vector<std::uint32_t> found;
  const auto near = bg::index::intersects(tree_box(box, margin_m));
  for (auto it = impl_->tree.qbegin(near); it != impl_->tree.qend(); ++it)
    found.push_back(it->second);
  std::sort(found.begin(), found.end());  // the tree's own order is nobody's business
  return found;
}

}  // namespace enfilade
