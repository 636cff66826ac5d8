// Links: how much of a shooter's light arrives at a receiver. They belong to the receiver (§4.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "hierarchy/patch.hpp"

namespace enfilade {

/// A shooter is a node of some cluster, or (cluster = none) the point light numbered shooter.root.
struct Link {
  ClusterId shooter_cluster;
  PatchId shooter;
  PatchId receiver;
  float shooter_x = 0.0f,
        shooter_y = 0.0f;  ///< the shooting patch's centroid, in its polygon's frame
  float error = 0.0f;  ///< estimated error of the received power (m2) per unit of mean radiosity
  float variation = 0.0f;  ///< the same per unit of the shooter's RMS variation around it
  bool evaluated = false;  ///< false: its shooter had no light yet, transport is not known
  bool finest = false;     ///< neither side can be split further
  std::uint8_t visibility_uncertainty = 0;  ///< 255ths of `error` that are doubt about visibility
  float visibility_error() const {
    return error * static_cast<float>(visibility_uncertainty) / 255.0f;
  }
  bool is_light() const { return !shooter_cluster.valid(); }
  bool operator==(const Link&) const = default;
};

/// The links of one receiving cluster, each with `stride` transport coefficients: receiver term by
/// shooter term (unit: irradiance per radiosity, 1 for constant-constant).
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
  void add(const Link& link, std::span<const float> transport);
  /// The first n links of another set, and no others.
  void take_first(const LinkSet& other, std::size_t n);
  bool operator==(const LinkSet&) const = default;

 private:
  friend class ClusterStateCodec;
  std::size_t stride_ = 1;
  std::vector<Link> links_;
  std::vector<float> transport_;
};

/// A group that receives a beam of light passes it to those of its polygons that turn towards it:
/// calls take(polygon, cosine) for them. `transport` is the link's.
template <class Take>
void for_each_facing(const PatchForest& receiver, const Link& link,
                     std::span<const float> transport, Take take) {
  const GroupNode& group = receiver.groups()[link.receiver.group()];
  const Vec3 toward(transport[1], transport[2], transport[3]);
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = receiver.order()[i];
    const double cosine = glm::dot(receiver.frames()[k].n, toward);
    if (cosine > 0.0 && !receiver.unreachable(k)) take(k, cosine);
  }
}

/// Area times form factor (m2) from the shooter as a whole: what its mean radiosity brings in
/// power.
double area_factor(const PatchForest& receiver, const Link& link, std::span<const float> transport);

}  // namespace enfilade
