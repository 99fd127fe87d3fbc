#include "core/plant/source_ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace loopscope::core::plant {
namespace {

/// In the order of SourceFigures::members.
constexpr std::array<double, kSourceFigures> kWeights = {0.61, 2.80, 0.85, -2.46,
                                                         0.71, 1.94, 2.43, 1.22};
constexpr double kOutsideScore = 4.93;
constexpr double kNoLeaderWeight = -4.32;

double weigh(const std::array<double, kSourceFigures>& figures) {
  return std::inner_product(figures.begin(), figures.end(), kWeights.begin(), 0.0);
}

}  // namespace

SourceOdds rank_sources(std::span<const SourceEvidence> evidence) {
  SourceOdds odds;
  if (evidence.empty()) return odds;
  const SourceFigures figures = figures_of(evidence);
  const double outside = kOutsideScore + kNoLeaderWeight * figures.no_leader;
  std::vector<double> scores;
  for (const auto& one : figures.members) scores.push_back(weigh(one));
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
