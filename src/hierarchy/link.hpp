// Links: how much of a shooter's light arrives at a receiver. A link belongs to its receiver
// (§4.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// A link from a shooter to a node of the receiving cluster. The shooter is a node of some cluster,
/// or (cluster = none) the point light numbered shooter.root, or (cluster = none, and a group) node
/// shooter.group() of the building's tree (clusters/building_tree.hpp).
struct Link {
  ClusterId shooter_cluster;
  PatchId shooter;
  PatchId receiver;
  /// The shooting patch's centroid, in its polygon's frame; of a far shooter: the direction from it
  /// to the receiver, as fold_direction() of far_field/far_view.hpp returns it.
  float shooter_x = 0.0f, shooter_y = 0.0f;
  /// Estimated error of the received power per unit of the shooter's mean radiosity; unit: m2.
  float error = 0.0f;
  /// Estimated error of the received power per unit of the RMS variation of the shooter's radiosity
  /// around its mean; unit: m2.
  float variation = 0.0f;
  bool evaluated = false;  ///< false: its shooter had no light yet, transport is not known
  bool finest = false;     ///< neither side can be split further
  std::uint8_t visibility_uncertainty = 0;  ///< 255ths of `error` that come from visibility
  /// Returns the part of `error` that comes from visibility; unit: m2.
  float visibility_error() const {
    return error * static_cast<float>(visibility_uncertainty) / 255.0f;
  }
  bool is_light() const { return !shooter_cluster.valid() && !shooter.is_group(); }
  bool is_far() const { return !shooter_cluster.valid() && shooter.is_group(); }
  bool operator==(const Link&) const = default;
};

/// The links of one receiving cluster, each with `stride` transport coefficients: receiver term by
/// shooter term. The first is irradiance per radiosity (no unit); rows of gradients of the
/// irradiance have 1/m, columns of gradients of the radiosity have m.
class LinkSet {
 public:
  LinkSet() = default;
  explicit LinkSet(std::size_t stride) : stride_(stride) {}

  std::size_t size() const { return links_.size(); }
  std::size_t stride() const { return stride_; }
  const Link& operator[](std::size_t i) const { return links_[i]; }
  Link& operator[](std::size_t i) { return links_[i]; }
  std::span<const float> transport(std::size_t i) const {
    return {transport_.data() + i * stride_, stride_};
  }
  std::span<float> transport(std::size_t i) { return {transport_.data() + i * stride_, stride_}; }
  /// Of a link through tinted panes, `tint`: what passes in each band, relative to the transport;
  /// empty: the same in all bands.
  void add(const Link& link, std::span<const float> transport, std::span<const double> tint = {});
  /// Adds link i of another set.
  void add_from(const LinkSet& other, std::size_t i);
  std::span<const float> tint(std::size_t i) const {
    return {tint_.data() + i * tint_bands_, tint_bands_};
  }
  /// Replaces all links by the first n of another set.
  void take_first(const LinkSet& other, std::size_t n);
  /// Returns the bytes on the heap.
  std::size_t memory_bytes() const;
  /// Gives back the memory that growing vectors have reserved.
  void shrink();
  bool operator==(const LinkSet&) const = default;

 private:
  friend class ClusterCodec;
  std::size_t stride_ = 1;
  std::vector<Link> links_;
  std::vector<float> transport_;
  std::size_t tint_bands_ = 0;  ///< of each link; 0 while no link is tinted
  std::vector<float> tint_;
};

/// Calls take(polygon, cosine) for those polygons of a receiving group that face the link's
/// direction and are not unreachable. A group receives as if light came from one direction,
/// transport[1..3]; where that is 0, from all sides: by all polygons alike, with cosine 1.
template <class Take>
void for_each_facing(const PatchForest& receiver, const Link& link,
                     std::span<const float> transport, Take take) {
  const GroupNode& group = receiver.groups()[link.receiver.group()];
  const Vec3 toward(transport[1], transport[2], transport[3]);
  const bool all_sides = toward == Vec3(0.0);
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = receiver.order()[i];
    const double cosine = all_sides ? 1.0 : glm::dot(receiver.frames()[k].n, toward);
    if (cosine > 0.0 && !receiver.unreachable(k)) take(k, cosine);
  }
}

/// Which transport coefficients of a far link are its form factor, and its irradiance per unit of
/// the node's mean exitance. The first coefficient, irradiance per unit of the reflected radiosity,
/// is weighted by how that is distributed over the node.
struct FarTerms {
  std::size_t factor, emitted;
  static FarTerms of(const Link& link) { return of(link.receiver.is_group()); }
  static FarTerms of(bool receiver_is_group) {
    return receiver_is_group ? FarTerms{4, 5} : FarTerms{1, 2};
  }
};

/// Returns the number of shooting clusters but `own`; links lie in the order of their shooters.
std::uint64_t linked_clusters(const LinkSet& links, ClusterId own);

/// Returns area times form factor of a link (m2): received power per unit of the shooter's mean
/// radiosity.
double area_factor(const PatchForest& receiver, const Link& link, std::span<const float> transport);

}  // namespace enfilade
