#include "core/model/record/loop_data.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

/// Short blocks of uneven length: setpoint moves, cycles and shifts that come at regular times then
/// fall to both kinds alike. Shorter ones than 24 samples would be mostly guard.
constexpr std::size_t kShortestBlock = 24;
/// Of the few renewals of a held sensor both kinds still get eight blocks: what happens at regular
/// times comes after fewer rows there. Still shorter ones would be mostly guard.
constexpr std::size_t kFewestHeldBlocks = 16;
constexpr std::size_t kShortestHeldBlock = 12;
/// Fractional parts of multiples of the golden ratio fill an interval evenly without a pattern.
constexpr double kGolden = 0.6180339887498949;
/// The memory of a one-step error: a few samples.
constexpr std::size_t kGuard = 4;
constexpr std::size_t kWarmUp = 40;
/// Of few renewals no larger part is given away: the lags take a few of them, the noise some more.
constexpr std::size_t kPartsOfHeldRecord = 12;
/// After a gap the prediction leans on bridged samples for about so long.
constexpr std::size_t kAfterGap = 12;

/// Straight lines across gaps, the nearest value at the ends; less `mean`, times `factor`.
std::vector<double> bridged(std::span<const double> values, double mean, double factor) {
  std::vector<double> result(values.size(), 0.0);
  std::size_t last = values.size();
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isnan(values[k])) continue;
    result[k] = (values[k] - mean) * factor;
    const std::size_t from = last == values.size() ? 0 : last + 1;
    for (std::size_t j = from; j < k; ++j) {
      const double share = last == values.size()
                               ? 1.0
                               : static_cast<double>(j - last) / static_cast<double>(k - last);
      const double left = last == values.size() ? result[k] : result[last];
      result[j] = left + share * (result[k] - left);
    }
    last = k;
  }
  if (last < values.size())
    std::fill(result.begin() + static_cast<long>(last) + 1, result.end(), result[last]);
  return result;
}

/// By row, whether pv or a sample of op since the row before is missing.
std::vector<bool> missing_rows(std::span<const double> pv, std::span<const double> op,
                               const RowGrid& grid) {
  std::vector<bool> missing(pv.size());
  for (std::size_t row = 0; row < pv.size(); ++row) missing[row] = std::isnan(pv[row]);
  for (std::size_t k = 0; k < op.size(); ++k) {
    const std::size_t row = grid.row_from(k);
    if (std::isnan(op[k]) && row < missing.size()) missing[row] = true;
  }
  return missing;
}

std::vector<bool> countable(const std::vector<bool>& missing, const RowGrid& grid) {
  std::vector<bool> usable(missing.size(), true);
  const std::size_t warm_up = std::min(warm_up_rows(grid, missing.size()), missing.size());
  for (std::size_t k = 0; k < warm_up; ++k) usable[k] = false;
  for (std::size_t k = 0; k < missing.size(); ++k) {
    if (!missing[k]) continue;
    for (std::size_t j = k; j < std::min(missing.size(), k + kAfterGap); ++j) usable[j] = false;
  }
  return usable;
}

void add_runs(const std::vector<bool>& usable, Range block, std::vector<Range>& ranges) {
  std::size_t first = block.first;
  for (std::size_t k = block.first; k <= block.end; ++k) {
    if (k < block.end && usable[k]) continue;
    if (k > first) ranges.push_back({first, k});
    first = k + 1;
  }
}

/// Of blocks that are twice as long in the mean.
std::size_t shortest_block(const RowGrid& grid, std::size_t rows) {
  if (grid.every_sample()) return kShortestBlock;
  return std::clamp(rows / (2 * kFewestHeldBlocks), kShortestHeldBlock, kShortestBlock);
}

Rows lay_out(const std::vector<bool>& usable, std::size_t shortest) {
  Rows rows;
  std::size_t first = 0;
  for (std::size_t block = 0; first < usable.size(); ++block) {
    const double spread = std::fmod(kGolden * static_cast<double>(block), 1.0);
    const std::size_t length =
        shortest + static_cast<std::size_t>(spread * static_cast<double>(2 * shortest));
    const std::size_t begin = std::min(usable.size(), first + kGuard);
    const Range range{begin, std::min(usable.size(), first + length)};
    add_runs(usable, {first, begin}, rows.guard);
    first += length;
    if (range.first < range.end) add_runs(usable, range, block % 2 == 0 ? rows.fit : rows.score);
  }
  return rows;
}

std::size_t count(const std::vector<Range>& ranges) {
  return std::accumulate(ranges.begin(), ranges.end(), std::size_t{0},
                         [](std::size_t sum, const Range& range) { return sum + range.size(); });
}

/// `ranges` (ascending, apart) and `added` in one.
std::vector<Range> united(const std::vector<Range>& ranges, Range added) {
  std::vector<Range> result;
  for (const Range& range : ranges) {
    const bool apart = range.end < added.first || range.first > added.end;
    if (apart) {
      result.push_back(range);
    } else {
      added = {std::min(added.first, range.first), std::max(added.end, range.end)};
    }
  }
  result.push_back(added);
  std::ranges::sort(result, {}, &Range::first);
  return result;
}

}  // namespace

std::size_t warm_up_rows(const RowGrid& grid, std::size_t rows) {
  return grid.every_sample() ? kWarmUp : std::min(kWarmUp, rows / kPartsOfHeldRecord);
}

std::size_t Rows::fit_count() const {
  return count(fit);
}

std::size_t Rows::score_count() const {
  return count(score);
}

LoopData on_other_fold(LoopData data) {
  std::swap(data.rows.fit, data.rows.score);
  return data;
}

LoopData seen_whole(LoopData data) {
  for (const Range& range : data.rows.score) data.rows.fit = united(data.rows.fit, range);
  return data;
}

Rows seen_by_both(const Rows& rows, std::size_t at, std::size_t length) {
  if (rows.fit.empty() || rows.score.empty()) return rows;
  const std::size_t last = std::max(rows.fit.back().end, rows.score.back().end);
  const Range window{std::min(at, last - 1), std::min(at + length, last)};
  return {united(rows.fit, window), united(rows.score, window), rows.guard};
}

LoopData make_loop_data(std::span<const double> pv, std::span<const double> op,
                        double sample_interval_s, const RowGrid& grid) {
  LoopData data;
  data.grid = grid;
  data.sample_interval_s = sample_interval_s;
  const std::vector<double> pv_rows = at_rows(grid, pv);
  const signal::Spread pv_spread = signal::measure_spread(pv_rows).value_or(signal::Spread{});
  data.pv_mean = pv_spread.mean;
  data.pv_scale = pv_spread.std > 0.0 ? pv_spread.std : 1.0;
  data.op_mean = signal::measure_spread(op).value_or(signal::Spread{}).mean;
  data.pv = bridged(pv_rows, data.pv_mean, 1.0 / data.pv_scale);
  data.op = bridged(op, data.op_mean, 1.0);
  data.rows = lay_out(countable(missing_rows(pv_rows, op, grid), grid),
                      shortest_block(grid, data.pv.size()));
  return data;
}

}  // namespace loopscope::core::model
