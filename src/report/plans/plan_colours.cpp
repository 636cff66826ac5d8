#include "report/plans/plan_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/drawing/drawing.hpp"

namespace enfilade {

namespace {

/// The colour 0xrrggbb.
Rgb8 rgb_of(std::uint32_t hex) {
  const auto byte = [hex](int shift) { return static_cast<std::uint8_t>((hex >> shift) & 0xff); };
  return {byte(16), byte(8), byte(0)};
}

/// Hue in degrees, saturation and lightness in [0, 1].
Rgb8 from_hsl(double hue, double saturation, double lightness) {
  const double a = saturation * std::min(lightness, 1.0 - lightness);
  const auto channel = [&](double n) {
    const double k = std::fmod(n + hue / 30.0, 12.0);
    const double v = lightness - a * std::max(-1.0, std::min({k - 3.0, 9.0 - k, 1.0}));
    return static_cast<std::uint8_t>(std::lround(255.0 * v));
  };
  return {channel(0.0), channel(8.0), channel(4.0)};
}

/// Light colours, neighbours in the list far apart; none grey, none like the portals' inks.
constexpr std::array<std::uint32_t, 12> pastel{0x8dd3c7, 0xfff3a3, 0xbebada, 0xfba999,
                                               0x9ecae1, 0xfdc880, 0xb3de69, 0xfccde5,
                                               0xcca2ce, 0xccebc5, 0xe5c494, 0xa8dde8};

/// The first colour from the cell's own on that no neighbour has yet.
std::size_t free_colour(std::size_t own, const std::vector<int>& given,
                        const std::vector<std::size_t>& neighbours) {
  std::array<bool, pastel.size()> taken{};
  for (const std::size_t n : neighbours) {
    if (given[n] >= 0) taken[static_cast<std::size_t>(given[n])] = true;
  }
  for (std::size_t i = 0; i < pastel.size(); ++i) {
    const std::size_t colour = (own + i) % pastel.size();
    if (!taken[colour]) return colour;
  }
  return own % pastel.size();
}

}  // namespace

Rgb8 rank_rgb(int rank) {
  // Ten colours that stay apart for most eyes, then hues by the golden angle.
  constexpr std::array<std::uint32_t, 10> first{0x4e79a7, 0xf28e2b, 0x59a14f, 0xe15759, 0x76b7b2,
                                                0xedc948, 0xb07aa1, 0x9c755f, 0xff9da7, 0x8a8580};
  if (rank >= 0 && rank < 10) return rgb_of(first[static_cast<std::size_t>(rank)]);
  return from_hsl(std::fmod(std::abs(rank) * 137.508, 360.0), 0.45 + 0.01 * (rank * 7 % 25),
                  0.48 + 0.01 * (rank * 5 % 20));
}

std::string rank_colour(int rank) { return css(rank_rgb(rank)); }

std::vector<Rgb8> cell_colours(const CellComplex& complex) {
  const auto& cells = complex.cells();
  std::vector<std::vector<std::size_t>> neighbours(cells.size());
  for (const Portal& portal : complex.portals()) {
    neighbours[portal.a.index()].push_back(portal.b.index());
    neighbours[portal.b.index()].push_back(portal.a.index());
  }
  std::vector<int> given(cells.size(), -1);
  std::vector<Rgb8> colours;
  std::size_t rooms = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].kind == CellKind::room) {
      const std::size_t colour = free_colour(rooms++, given, neighbours[c]);
      given[c] = static_cast<int>(colour);
      colours.push_back(rgb_of(pastel[colour]));
    } else {
      colours.push_back(cells[c].kind == CellKind::outside ? plan_ink::outside : plan_ink::solid);
    }
  }
  return colours;
}

Rgb8 tint(Rgb8 colour, double share) {
  for (std::uint8_t& channel : colour) {
    channel = static_cast<std::uint8_t>(std::lround(255.0 - share * (255.0 - channel)));
  }
  return colour;
}

}  // namespace enfilade
