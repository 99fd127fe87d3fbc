#include "core/signal/archive.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/signal/between_rows.hpp"
#include "core/signal/order/order_statistic.hpp"
#include "core/signal/order/sort_values.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::signal {
namespace {

/// Fewer samples missing here and there are read faults, not a way to store.
constexpr double kFewHoles = 0.02;
/// Rows that an archive stores for other reasons (start, time limit, quality) may lie closer.
constexpr double kExceptions = 0.01;
/// Distances that a smooth distribution would have below its edge; none has been seen, so that the
/// chance of no edge is exp(-7) = 1e-3.
constexpr double kEvidence = 7.0;
/// And so many times those that were seen: below the hundredth of a smooth distribution a hundredth
/// is expected.
constexpr double kMoreThanSeen = 5.0;
/// A band that is less than so many steps of the grid of values cannot be told from the grid.
constexpr double kStepsInBand = 2.5;
/// Spacings of a slower scan are equal but for a few.
constexpr double kRegular = 0.9;
/// Successive values stored on change differ.
constexpr double kEqual = 0.01;

struct Stored {
  std::vector<std::size_t> place;
  std::vector<double> value;
};

Stored compact(const Samples& samples) {
  Stored stored;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!std::isfinite(samples[k])) continue;
    stored.place.push_back(k);
    stored.value.push_back(samples[k]);
  }
  return stored;
}

/// Share of holes among the samples that are no gap.
double hole_share(const Stored& stored) {
  double holes = 0.0;
  for (std::size_t i = 1; i < stored.place.size(); ++i) {
    const std::size_t spacing = stored.place[i] - stored.place[i - 1];
    if (spacing <= kLongestBandedHole) holes += static_cast<double>(spacing - 1);
  }
  const auto rows = static_cast<double>(stored.place.size());
  return rows > 0.0 ? holes / (rows + holes) : 0.0;
}

/// The sharp lower edge of the magnitudes, if there is one.
std::optional<double> lower_edge(std::vector<double> sizes) {
  if (sizes.empty()) return std::nullopt;
  sort_values(sizes);
  const auto count = static_cast<double>(sizes.size());
  const double exceptions = std::floor(kExceptions * count);
  const double edge = sizes[static_cast<std::size_t>(exceptions)];
  const double expected = count * kNormalDensityAtZero * edge / sizes[sizes.size() / 2];
  if (!(expected >= kEvidence + kMoreThanSeen * exceptions)) return std::nullopt;
  return edge;
}

std::vector<double> moves_of(const Stored& stored) {
  std::vector<double> moves;
  for (std::size_t i = 1; i < stored.value.size(); ++i) {
    if (stored.place[i] - stored.place[i - 1] > kLongestBandedHole) continue;
    moves.push_back(std::abs(stored.value[i] - stored.value[i - 1]));
  }
  return moves;
}

/// Second differences of three that were stored one right after the other.
std::vector<double> bends_of(const Stored& stored) {
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < stored.value.size(); ++i) {
    if (stored.place[i + 1] - stored.place[i - 1] != 2) continue;
    bends.push_back(std::abs(stored.value[i + 1] - 2.0 * stored.value[i] + stored.value[i - 1]));
  }
  return bends;
}

bool regular(const Stored& stored) {
  std::map<std::size_t, std::size_t> spacings;
  for (std::size_t i = 1; i < stored.place.size(); ++i) {
    ++spacings[stored.place[i] - stored.place[i - 1]];
  }
  const auto usual = std::ranges::max_element(
      spacings, [](const auto& a, const auto& b) { return a.second < b.second; });
  return usual != spacings.end() && usual->first > 1 &&
         static_cast<double>(usual->second) >= kRegular * static_cast<double>(stored.place.size());
}

/// Values on a coarse grid of which no two in a row are equal.
bool on_change(const std::vector<double>& moves, double step) {
  const auto equal = static_cast<double>(std::ranges::count(moves, 0.0));
  const auto count = static_cast<double>(moves.size());
  const auto single = static_cast<double>(
      std::ranges::count_if(moves, [step](double move) { return move < 1.5 * step; }));
  constexpr double kUsually = 0.25;
  return equal <= kEqual * count && single >= kUsually * count;
}

/// `whole` without the runs of more than kLongestHole samples that `stored` lacks: a value that
/// stands still, or a line, where others do not is frozen or filled in.
Samples without_long_runs(Samples whole, const Samples& stored) {
  std::size_t first = 0;
  for (std::size_t k = 0; k <= whole.size(); ++k) {
    if (k < whole.size() && std::isnan(stored[k])) continue;
    if (k - first > kLongestHole) {
      std::fill(whole.begin() + static_cast<std::ptrdiff_t>(first),
                whole.begin() + static_cast<std::ptrdiff_t>(k), kMissing);
    }
    first = k + 1;
  }
  return whole;
}

/// Half the step of the grid of values where that is coarse, else 0.
double rounding_of(const Samples& samples) {
  const std::optional<Spread> spread = measure_spread(samples);
  const auto coarse = [&](double step) { return spread && step > kCoarseGrid * spread->std; };
  const std::optional<double> between_neighbours = smallest_neighbour_step(samples);
  if (between_neighbours && !coarse(*between_neighbours)) return 0.0;
  const double step = smallest_step(samples).value_or(0.0);
  return coarse(step) ? 0.5 * step : 0.0;
}

/// How the archive chose these samples, and the band by which it did.
void recognise(const Stored& stored, StoredSamples& result) {
  const double step = smallest_step(stored.value).value_or(0.0);
  const std::vector<double> moves = moves_of(stored);
  if (on_change(moves, step)) {
    result.archive = Archive::on_change;
    result.band = rounding_of(stored.value);
  } else if (const auto band = lower_edge(moves); band && *band > kStepsInBand * step) {
    result.archive = Archive::dead_band;
    result.band = *band;
  } else if (const auto bend = lower_edge(bends_of(stored)); bend && *bend > kStepsInBand * step) {
    result.archive = Archive::swinging_door;
    result.band = 0.5 * *bend;
  } else {
    result.archive = Archive::scattered;
  }
}

}  // namespace

std::string_view name(Archive archive) {
  switch (archive) {
    case Archive::complete:
      return "complete";
    case Archive::scattered:
      return "scattered";
    case Archive::on_change:
      return "on_change";
    case Archive::dead_band:
      return "dead_band";
    case Archive::swinging_door:
      return "swinging_door";
    case Archive::rounded:
      return "rounded";
    case Archive::coarser:
      return "coarser";
  }
  throw std::invalid_argument("signal: unknown archive");
}

StoredSamples find_stored(const Samples& pv, const Samples& rows) {
  const Samples& given = rows.empty() ? pv : rows;
  StoredSamples result;
  result.value = rows.empty() ? without_collinear(without_repeats(pv)) : rows;
  const Stored stored = compact(result.value);
  if (hole_share(stored) < kFewHoles) {
    result.value = without_long_runs(given, result.value);
    const bool holes = hole_share(compact(result.value)) > 0.0;
    result.band = rounding_of(result.value);
    result.archive = result.band > 0.0 ? Archive::rounded
                     : holes           ? Archive::scattered
                                       : Archive::complete;
  } else if (regular(stored)) {
    result.archive = Archive::coarser;
    result.value = pv;
  } else {
    recognise(stored, result);
  }
  return result;
}

}  // namespace loopscope::core::signal
