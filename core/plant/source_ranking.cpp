#include "core/plant/source_ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace loopscope::core::plant {
namespace {

/// In the order of SourceFigures::members.
constexpr std::array<double, kSourceFigures> kWeights = {0.78, 2.35, 0.67, -2.09,
                                                         0.36, 1.98, 0.42, 1.72};
/// In the order of SourceFigures::outside, then the constant.
constexpr std::array<double, kOutsideFigures> kOutsideWeights = {0.92, -3.06};
constexpr double kOutsideScore = 3.32;

double weigh(std::span<const double> figures, std::span<const double> weights) {
  return std::inner_product(figures.begin(), figures.end(), weights.begin(), 0.0);
}

}  // namespace

SourceOdds rank_sources(std::span<const SourceEvidence> evidence) {
  SourceOdds odds;
  if (evidence.empty()) return odds;
  const SourceFigures figures = figures_of(evidence);
  const double outside = kOutsideScore + weigh(figures.outside, kOutsideWeights);
  std::vector<double> scores;
  for (const auto& one : figures.members) scores.push_back(weigh(one, kWeights));
  const double largest = std::max(outside, *std::ranges::max_element(scores));
  odds.outside = std::exp(outside - largest);
  double sum = odds.outside;
  for (const double score : scores) {
    odds.members.push_back(std::exp(score - largest));
    sum += odds.members.back();
  }
  odds.outside /= sum;
  for (double& one : odds.members) one /= sum;
  return odds;
}

}  // namespace loopscope::core::plant
