#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/reproduce/example.hpp"
#include "daemon/reproduce/spread.hpp"

namespace loopscope::daemon {

/// How a paper's figure stands to ours.
enum class Agreement {
  met,       ///< between the 10th and 90th percentile of the seeds
  in_range,  ///< outside those, but between the smallest and largest
  not_met,   ///< outside all seeds
};
[[nodiscard]] std::string_view name(Agreement agreement);
[[nodiscard]] Agreement agreement_of(double paper, const Spread& ours);

/// In how many records a peak of the paper was found.
struct PeakShare {
  PaperPeak peak;
  bool in_principal_domain = true;
  double share = 0.0;  ///< of the seeds, 0 to 1
};

/// The most frequent verdict of the whole diagnosis.
struct VerdictShare {
  std::string code;
  double share = 0.0;  ///< of the seeds, 0 to 1
};

/// One example over all seeds.
struct Measurement {
  Spread ngi;
  Spread nli;
  Spread error_std;             ///< of the analysed signal, its units
  Spread max_f1, max_f2;        ///< strongest peak; zeros when no seed has one
  double peak_seeds = 0.0;      ///< share of seeds with any peak that stands out
  double decision_share = 0.0;  ///< of seeds in which the published rule decides as the paper did
  std::vector<PeakShare> peaks;
  std::optional<VerdictShare> verdict;  ///< loops only
};

/// Runs an example with seeds 1 to `seeds` (>= 1).
[[nodiscard]] Measurement measure(const Example& example, std::size_t seeds);

}  // namespace loopscope::daemon
