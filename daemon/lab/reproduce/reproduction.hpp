#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/lab/reproduce/example.hpp"

namespace loopscope::daemon {

/// How a figure spreads over the seeds.
struct Spread {
  double median = 0.0;
  double p10 = 0.0;  ///< 10th percentile, interpolated between order statistics
  double p90 = 0.0;  ///< 90th percentile
  double min = 0.0;
  double max = 0.0;
};

/// Spread of at least one value; throws std::invalid_argument for none.
[[nodiscard]] Spread spread_of(std::vector<double> values);

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

/// Runs an example with seeds 1 to `seeds` (>= 1). Throws std::runtime_error for a scenario whose
/// signal does not vary.
[[nodiscard]] Measurement measure(const Example& example, std::size_t seeds);

/// An example and what was measured of it.
struct MeasuredExample {
  Example example;
  Measurement measurement;
};

/// All examples of the paper over a number of seeds.
struct Reproduction {
  std::size_t seeds = 0;
  std::vector<MeasuredExample> examples;
};

/// measure() of every example with seeds 1 to `seeds` (>= 1).
[[nodiscard]] Reproduction reproduce_paper(std::size_t seeds);

}  // namespace loopscope::daemon
