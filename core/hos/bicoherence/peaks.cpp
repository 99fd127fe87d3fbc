#include "core/hos/bicoherence/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "core/hos/transforms/window.hpp"

namespace loopscope::core::hos {
namespace {

bool is_local_maximum(std::span<const double> bic2, const PrincipalDomain& domain, Bifrequency at) {
  const double value = bic2[domain.index(at)];
  for (std::size_t k2 = at.k2 - 1; k2 <= at.k2 + 1; ++k2) {
    for (std::size_t k1 = at.k1 - 1; k1 <= at.k1 + 1; ++k1) {
      if (domain.contains({k1, k2}) && bic2[domain.index({k1, k2})] > value) {
        return false;
      }
    }
  }
  return true;
}

/// Values looked at together: hardly any exceeds the level.
constexpr std::size_t kCellsTogether = 16;

bool none_above(double level, const double* values) {
  unsigned above = 0;
  for (std::size_t i = 0; i < kCellsTogether; ++i) above |= values[i] > level ? 1U : 0U;
  return above == 0;
}

double distance(std::size_t a, std::size_t b) {
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

}  // namespace

double peak_level(std::size_t segments, std::size_t bifrequencies, double alpha) {
  return std::log(static_cast<double>(bifrequencies) / alpha) / static_cast<double>(segments);
}

PeakFinder::PeakFinder(const Settings& settings)
    : settings_(settings),
      domain_(settings.dft_length),
      lobe_(main_lobe_half_width(settings.window) * static_cast<double>(settings.dft_length) /
            static_cast<double>(settings.segment_length)) {
  candidates_.reserve(domain_.rows());
  kept_.reserve(settings.max_peaks);
  peaks_.reserve(settings.max_peaks);
}

std::span<const Peak> PeakFinder::find(std::span<const double> bic2, std::size_t segments) {
  find_candidates(bic2, peak_level(segments, domain_.size(), settings_.alpha));
  kept_.clear();
  peaks_.clear();
  const auto bins = static_cast<double>(settings_.dft_length);
  for (const Candidate& next : candidates_) {
    if (kept_.size() == settings_.max_peaks) break;
    if (!is_distinct(next)) continue;
    kept_.push_back(next);
    peaks_.push_back({static_cast<double>(next.at.k1) / bins,
                      static_cast<double>(next.at.k2) / bins, next.bic2, std::nullopt});
  }
  return peaks_;
}

void PeakFinder::find_candidates(std::span<const double> bic2, double level) {
  candidates_.clear();
  for (std::size_t i = 0; i < bic2.size(); ++i) {
    if (i % kCellsTogether == 0 && i + kCellsTogether <= bic2.size() &&
        none_above(level, &bic2[i])) {
      i += kCellsTogether - 1;
      continue;
    }
    if (!(bic2[i] > level)) continue;
    const Bifrequency at = domain_.at(i);
    if (is_local_maximum(bic2, domain_, at)) candidates_.push_back({i, at, bic2[i]});
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.bic2 > b.bic2 || (a.bic2 == b.bic2 && a.index < b.index);
  });
}

bool PeakFinder::is_distinct(const Candidate& next) const {
  return std::none_of(kept_.begin(), kept_.end(), [&](const Candidate& stronger) {
    return distance(next.at.k1, stronger.at.k1) <= lobe_ &&
           distance(next.at.k2, stronger.at.k2) <= lobe_;
  });
}

std::vector<Peak> find_peaks(std::span<const double> bic2, std::size_t segments,
                             const Settings& settings) {
  PeakFinder finder(settings);
  const std::span<const Peak> peaks = finder.find(bic2, segments);
  return {peaks.begin(), peaks.end()};
}

}  // namespace loopscope::core::hos
