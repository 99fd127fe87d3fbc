#include "core/plant/source_ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace loopscope::core::plant {
namespace {

/// In the order of figures_of().
constexpr std::array<double, kSourceFigures> kWeights = {0.67, 1.32, -1.70, 1.68, 3.37, 0.76};
constexpr double kOutsideScore = 6.17;

double score_of(const SourceEvidence& evidence) {
  const std::array<double, kSourceFigures> figures = figures_of(evidence);
  return std::inner_product(figures.begin(), figures.end(), kWeights.begin(), 0.0);
}

}  // namespace

SourceOdds rank_sources(std::span<const SourceEvidence> evidence) {
  std::vector<double> scores;
  for (const SourceEvidence& one : evidence) scores.push_back(score_of(one));
  double largest = kOutsideScore;
  for (const double score : scores) largest = std::max(largest, score);
  SourceOdds odds;
  odds.outside = std::exp(kOutsideScore - largest);
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
