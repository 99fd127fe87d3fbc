#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/hos/analyse.hpp"
#include "core/hos/settings.hpp"

namespace loopscope::core::hos {

/// Squared bicoherence that the largest of `bifrequencies` (L) values exceeds with a probability
/// of about alpha when nothing is coupled: ln(L / alpha) / K. By the published null K bic2 is
/// exponential (eq. 9 with one bifrequency); L is Bonferroni's correction, close to the truth in
/// spite of correlated neighbours (README, false alarms).
[[nodiscard]] double peak_level(std::size_t segments, std::size_t bifrequencies, double alpha);

/// The strongest distinct peaks of `bic2` (values over the principal domain of
/// settings.dft_length), strongest first, at most settings.max_peaks.
///
/// A peak exceeds all its neighbours and peak_level(), and lies outside the window's main lobe
/// around every stronger one: within that lobe a single coupled triple of lines is seen several
/// times. Frequencies are bin centres, k / dft_length cycles per sample. `p` is not computed.
[[nodiscard]] std::vector<Peak> find_peaks(std::span<const double> bic2, std::size_t segments,
                                           const Settings& settings);

}  // namespace loopscope::core::hos
