// Covers the principal domain with tiles of bifrequencies and stores what they hold, row by row.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_DOMAIN_TILES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_DOMAIN_TILES_INL
#undef LOOPSCOPE_HOS_DOMAIN_TILES_INL
#else
#define LOOPSCOPE_HOS_DOMAIN_TILES_INL
#endif

#include <algorithm>
#include <cstddef>
#include <hwy/highway.h>

#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/kernels/principal_domain.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

/// Bifrequencies of a tile along k1 and k2, and the sums that it has of each.
template <std::size_t wide, std::size_t high, std::size_t sums>
struct TileShape {
  static constexpr std::size_t kWide = wide;
  static constexpr std::size_t kHigh = high;
  static constexpr std::size_t kSums = sums;
  static constexpr std::size_t kRow = kWide * kSums;  ///< doubles of one k2
};

/// Height of the tile at (k1, k2) that holds every bifrequency of the domain in `wide` columns.
HWY_INLINE std::size_t tile_height(const PrincipalDomain& domain, Bifrequency at, std::size_t wide,
                                   std::size_t most) {
  std::size_t height = 0;
  for (std::size_t k1 = at.k1; k1 < at.k1 + wide; ++k1) {
    while (height < most && domain.contains({k1, at.k2 + height})) ++height;
  }
  return height;
}

/// The tiles that hold k2 .. k2 + kHigh - 1, as far as the domain has them. sum(k1, height, sums)
/// fills kRow doubles for each k2 of a tile; store_row(place, row, first, last) takes columns
/// first .. last - 1 of one of these rows to bifrequencies place + first .. of the domain. What
/// sticks out of the domain is dropped.
template <class Shape, class Sum, class Store>
HWY_INLINE void sweep_band(const PrincipalDomain& domain, std::size_t k2, const Sum& sum,
                           const Store& store_row) {
  constexpr std::size_t kWide = Shape::kWide;
  alignas(kAlignment) double sums[Shape::kHigh * Shape::kRow + kWidth];
  const std::size_t columns = domain.row_size(k2);
  const std::size_t rows = std::min(Shape::kHigh, domain.rows() + 1 - k2);
  std::size_t places[Shape::kHigh];
  for (std::size_t j = 0; j < rows; ++j) places[j] = domain.row_begin(k2 + j) - j;
  for (std::size_t c = 0; c < columns; c += kWide) {
    if (c + 1 >= rows && c + kWide + rows <= columns + 1) {
      sum(k2 + c, rows, sums);
#pragma GCC unroll 8
      for (std::size_t j = 0; j < Shape::kHigh; ++j) {
        if (j < rows) store_row(places[j] + c, sums + j * Shape::kRow, 0, kWide);
      }
    } else {
      const std::size_t height = tile_height(domain, {k2 + c, k2}, kWide, rows);
      sum(k2 + c, height, sums);
      for (std::size_t j = 0; j < height; ++j) {
        store_row(places[j] + c, sums + j * Shape::kRow, j > c ? j - c : 0,
                  std::min(kWide, columns - j - c));
      }
    }
  }
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_DOMAIN_TILES_INL
