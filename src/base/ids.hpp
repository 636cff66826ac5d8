// Strong ids: a cluster's number does not convert into a cell's.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace enfilade {

/// A 32-bit index into one kind of thing; the default is "none".
template <class Tag>
struct Id {
  static constexpr std::uint32_t none_value = 0xFFFFFFFFu;
  std::uint32_t value = none_value;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
  constexpr explicit Id(int v) : value(static_cast<std::uint32_t>(v)) {}
  constexpr bool valid() const { return value != none_value; }
  constexpr std::size_t index() const { return value; }
  constexpr auto operator<=>(const Id&) const = default;
};

using SurfaceId = Id<struct SurfaceTag>;  ///< index of a surface in the scene file
using CellId = Id<struct CellTag>;
using PortalId = Id<struct PortalTag>;
using ClusterId = Id<struct ClusterTag>;
using LightId = Id<struct LightTag>;  ///< index of a point light in the scene file

/// An MPI rank, 0 .. ranks-1.
struct Rank {
  int value = 0;
  constexpr auto operator<=>(const Rank&) const = default;
};

}  // namespace enfilade

template <class Tag>
struct std::hash<enfilade::Id<Tag>> {
  std::size_t operator()(enfilade::Id<Tag> id) const noexcept { return id.value; }
};
