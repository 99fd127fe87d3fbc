#include "core/signal/holes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loopscope::core::signal {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

std::size_t longest_hole(Archive archive) {
  return archive == Archive::scattered ? kLongestHole : kLongestBandedHole;
}

/// Fills the run [first, last) between stored samples; behind the last one of a record (`last` is
/// its size) a dead band holds.
class Filler {
 public:
  Filler(const StoredSamples& stored, Reconstruction& result) : stored_(stored), result_(result) {}

  void fill(std::size_t first, std::size_t last) {
    if (first == 0 || last == first || last - first > longest_hole(stored_.archive)) return;
    const bool holds =
        stored_.archive == Archive::dead_band || stored_.archive == Archive::on_change;
    if (last == stored_.value.size() && !holds) return;
    for (std::size_t k = first; k < last; ++k) guess(first, last, k);
  }

  /// What was stored is the value rounded to the grid.
  void bound_stored() {
    for (std::size_t k = 0; k < stored_.value.size(); ++k) {
      if (std::isfinite(stored_.value[k])) bound(k, stored_.value[k], stored_.band);
    }
  }

 private:
  void guess(std::size_t first, std::size_t last, std::size_t k) {
    const double before = stored_.value[first - 1];
    const double after = last < stored_.value.size() ? stored_.value[last] : before;
    const double share = static_cast<double>(k - first + 1) / static_cast<double>(last - first + 1);
    const double line = before + share * (after - before);
    switch (stored_.archive) {
      case Archive::on_change:
        result_.value[k] = before;
        if (stored_.band > 0.0) bound(k, before, stored_.band);
        break;
      case Archive::dead_band:
        bound(k, before, stored_.band);
        result_.value[k] = std::clamp(line, result_.low[k], result_.high[k]);
        break;
      case Archive::swinging_door:
        bound(k, line, stored_.band);
        result_.value[k] = line;
        break;
      default:
        bound(k, 0.0, kUnbounded);
        result_.value[k] = line;
    }
  }

  void bound(std::size_t k, double centre, double band) {
    if (result_.low.empty()) {
      result_.low.assign(stored_.value.size(), kMissing);
      result_.high = result_.low;
    }
    result_.low[k] = centre - band;
    result_.high[k] = centre + band;
  }

  const StoredSamples& stored_;
  Reconstruction& result_;
};

}  // namespace

Reconstruction reconstruct(const StoredSamples& stored) {
  Reconstruction result{stored.value, {}, {}};
  Filler filler(stored, result);
  const bool coarse = stored.archive == Archive::rounded || stored.archive == Archive::on_change;
  if (coarse && stored.band > 0.0) filler.bound_stored();
  std::size_t first = 0;
  for (std::size_t k = 0; k <= stored.value.size(); ++k) {
    if (k < stored.value.size() && std::isnan(stored.value[k])) continue;
    if (k > first) filler.fill(first, k);
    first = k + 1;
  }
  return result;
}

}  // namespace loopscope::core::signal
