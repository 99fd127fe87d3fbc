#include "core/loop/pv_plateaus.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace loopscope::core::loop {
namespace {

constexpr double kFewestCycles = 3.0;
constexpr double kShortestCycle = 6.0;
/// A jump of a stiff valve takes less than a twelfth of the cycle, and twelve means show a half
/// cycle's shape.
constexpr double kMeansInACycle = 12.0;
/// A sine is this slow for a ninth of the time.
constexpr double kSlow = 0.25;
/// Fewer moves have no kurtosis to speak of.
constexpr std::size_t kFewestMoves = 24;

/// Running means of `width` samples, one for each full set; NaN where one is missing.
std::vector<double> running_means(std::span<const double> values, std::size_t width) {
  std::vector<double> means;
  for (std::size_t k = 0; k + width <= values.size(); ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < width; ++i) sum += values[k + i];
    means.push_back(sum / static_cast<double>(width));
  }
  return means;
}

/// From each mean to the next that shares no sample with it.
std::vector<double> moves_of(const std::vector<double>& means, std::size_t width) {
  std::vector<double> moves;
  for (std::size_t k = 0; k + width < means.size(); ++k)
    moves.push_back(means[k + width] - means[k]);
  return moves;
}

struct Moments {
  double mean_square = 0.0;
  double kurtosis = 0.0;
  std::size_t count = 0;
};

Moments moments_of(const std::vector<double>& moves) {
  double squares = 0.0, fourths = 0.0;
  Moments moments;
  for (const double move : moves) {
    if (std::isnan(move)) continue;
    ++moments.count;
    squares += move * move;
    fourths += move * move * move * move;
  }
  if (moments.count == 0 || !(squares > 0.0)) return moments;
  const auto count = static_cast<double>(moments.count);
  moments.mean_square = squares / count;
  moments.kurtosis = fourths / count / (moments.mean_square * moments.mean_square);
  return moments;
}

}  // namespace

std::optional<PvPlateaus> measure_pv_plateaus(std::span<const double> pv,
                                              std::span<const double> op, double period_samples,
                                              bool integrating) {
  if (op.size() != pv.size() || !(period_samples >= kShortestCycle)) return std::nullopt;
  PvPlateaus rests;
  rests.cycles = static_cast<double>(pv.size()) / period_samples;
  if (rests.cycles < kFewestCycles) return std::nullopt;
  const auto width =
      static_cast<std::size_t>(std::max(1.0, std::round(period_samples / kMeansInACycle)));
  std::vector<double> pv_moves = moves_of(running_means(pv, width), width);
  std::vector<double> op_moves = moves_of(running_means(op, width), width);
  if (integrating) {
    pv_moves = moves_of(pv_moves, width);
    // The bend of pv at k + width is seen between the moves to either side.
    op_moves.erase(op_moves.begin(), op_moves.begin() + static_cast<std::ptrdiff_t>(
                                                            std::min(width, op_moves.size())));
  }
  const Moments moments = moments_of(pv_moves);
  if (moments.count < kFewestMoves || !(moments.mean_square > 0.0)) return std::nullopt;
  const double slow = kSlow * std::sqrt(moments.mean_square);
  double travel = 0.0, travel_at_rest = 0.0, resting = 0.0;
  for (std::size_t k = 0; k < std::min(pv_moves.size(), op_moves.size()); ++k) {
    if (std::isnan(pv_moves[k]) || std::isnan(op_moves[k])) continue;
    const bool rests_here = std::abs(pv_moves[k]) < slow;
    travel += std::abs(op_moves[k]);
    if (!rests_here) continue;
    resting += 1.0;
    travel_at_rest += std::abs(op_moves[k]);
  }
  if (!(travel > 0.0)) return std::nullopt;
  rests.move_kurtosis = moments.kurtosis;
  rests.time_share = resting / static_cast<double>(moments.count);
  rests.op_travel_share = travel_at_rest / travel;
  return rests;
}

}  // namespace loopscope::core::loop
