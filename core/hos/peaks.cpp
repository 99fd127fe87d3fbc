#include "core/hos/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "core/hos/principal_domain.hpp"
#include "core/hos/window.hpp"

namespace loopscope::core::hos {
namespace {

struct Candidate {
  Bifrequency at;
  double bic2;
};

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

std::vector<Candidate> candidates(std::span<const double> bic2, const PrincipalDomain& domain,
                                  double level) {
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < bic2.size(); ++i) {
    if (bic2[i] > level && is_local_maximum(bic2, domain, domain.at(i))) {
      found.push_back({domain.at(i), bic2[i]});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.bic2 > b.bic2; });
  return found;
}

double distance(std::size_t a, std::size_t b) {
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

}  // namespace

double peak_level(std::size_t segments, std::size_t bifrequencies, double alpha) {
  return std::log(static_cast<double>(bifrequencies) / alpha) / static_cast<double>(segments);
}

std::vector<Peak> find_peaks(std::span<const double> bic2, std::size_t segments,
                             const Settings& settings) {
  const PrincipalDomain domain(settings.dft_length);
  const auto bins = static_cast<double>(settings.dft_length);
  const double lobe =
      main_lobe_half_width(settings.window) * bins / static_cast<double>(settings.segment_length);
  std::vector<Candidate> kept;
  for (const Candidate& next :
       candidates(bic2, domain, peak_level(segments, domain.size(), settings.alpha))) {
    const bool distinct = std::none_of(kept.begin(), kept.end(), [&](const Candidate& stronger) {
      return distance(next.at.k1, stronger.at.k1) <= lobe &&
             distance(next.at.k2, stronger.at.k2) <= lobe;
    });
    if (distinct && kept.size() < settings.max_peaks) {
      kept.push_back(next);
    }
  }
  std::vector<Peak> peaks;
  for (const Candidate& peak : kept) {
    peaks.push_back({static_cast<double>(peak.at.k1) / bins, static_cast<double>(peak.at.k2) / bins,
                     peak.bic2, std::nullopt});
  }
  return peaks;
}

}  // namespace loopscope::core::hos
