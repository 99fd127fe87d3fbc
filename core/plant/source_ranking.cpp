#include "core/plant/source_ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace loopscope::core::plant {
namespace {

/// In the order of SourceFigures::members and none.
constexpr std::array<double, kSourceFigures> kWeights = {0.72, 2.03, 1.16, 2.75, 0.85, 5.13, -3.15};
constexpr std::array<double, kNoneFigures> kNoneWeights = {-3.51, -1.18};
constexpr double kNoneScore = 5.56;

double weigh(std::span<const double> figures, std::span<const double> weights) {
  return std::inner_product(figures.begin(), figures.end(), weights.begin(), 0.0);
}

}  // namespace

SourceOdds rank_sources(std::span<const SourceEvidence> evidence) {
  SourceOdds odds;
  if (evidence.empty()) return odds;
  const SourceFigures figures = figures_of(evidence);
  const double outside = kNoneScore + weigh(figures.none, kNoneWeights);
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
