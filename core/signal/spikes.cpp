#include "core/signal/spikes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/signal/loop_prediction.hpp"
#include "core/signal/neighbour_errors.hpp"
#include "core/signal/order/order_statistic.hpp"
#include "core/signal/order/spread.hpp"
#include "core/signal/tail_law.hpp"

namespace loopscope::core::signal {
namespace {

constexpr std::size_t kBeside = 2;
constexpr double kFarOff = 10.0;
/// 61 of 4096: room for the 40 that a bad day of a transmitter gives.
constexpr double kMostSpikes = 0.015;

/// Nothing that the signal does by itself within two samples, but noise, is larger than this many
/// of its standard deviations: tips and edges of a cycle are not.
constexpr double kLarge = 2.5;

/// Spikes hide each other in the tail that they lengthen; what is left is as good as settled then.
constexpr int kRounds = 4;

/// Samples on either side that tell how loud the signal is there, and what is louder than elsewhere
/// (their median is known within an eighth).
constexpr std::size_t kAround = 32;
constexpr double kLoud = 1.5;

/// Share of a run's height that its own loop may foretell of an outlier.
constexpr double kUnforeseen = 0.5;

/// Share of the outliers that chance may have made (Benjamini and Hochberg 1995).
constexpr double kByChance = 0.05;

/// The larger and the smaller of two, without a branch.
double larger(double a, double b) {
  return a > b ? a : b;
}
double smaller(double a, double b) {
  return a < b ? a : b;
}

/// Of five values the third: what is left when the least of one half and the most of the other are
/// dropped in turn. Anything when one is NaN.
double median_of_five(const double* v) {
  const double low = larger(smaller(v[0], v[1]), smaller(v[3], v[4]));
  const double high = smaller(larger(v[0], v[1]), larger(v[3], v[4]));
  return larger(smaller(v[2], low), smaller(larger(v[2], low), high));
}

/// Distance of sample k from the median of its five neighbours (itself included); 0 at the ends and
/// beside gaps, where there is too little to compare with.
double distance_at(const Samples& samples, std::size_t k) {
  if (k < kBeside || k + kBeside >= samples.size()) return 0.0;
  const double* const near = &samples[k - kBeside];
  const double middle = median_of_five(near);
  const double sum = near[0] + near[1] + near[2] + near[3] + near[4];
  return std::isnan(sum) ? 0.0 : std::abs(samples[k] - middle);
}

double usual_distance(std::vector<double> distances) {
  // The sample in the middle is the median itself in a fifth of the cases or more: zeros would pull
  // the scale down and are left out.
  std::erase(distances, 0.0);
  return distances.empty() ? 0.0 : kMadToSigma * median(std::move(distances));
}

/// Sizes of the errors that no sample of `suspect` touches; zeros are no errors.
std::vector<double> calm_sizes(const std::vector<double>& errors,
                               const std::vector<bool>& suspect) {
  std::vector<double> sizes;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (errors[k] != 0.0 && !suspect[k]) sizes.push_back(std::abs(errors[k]));
  }
  return sizes;
}

/// The usual size of the errors around sample k.
double usual_around(const std::vector<double>& errors, std::size_t k) {
  const std::size_t first = k > kAround ? k - kAround : 0;
  const std::size_t last = std::min(errors.size(), k + kAround + 1);
  std::vector<double> sizes;
  for (std::size_t i = first; i < last; ++i) sizes.push_back(std::abs(errors[i]));
  return median(std::move(sizes));
}

/// Finds spikes in one record.
class SpikeSearch {
 public:
  explicit SpikeSearch(const Samples& samples) : samples_(samples), found_(samples.size(), false) {
    for (std::size_t k = 0; k < samples.size(); ++k) distances_.push_back(distance_at(samples, k));
    far_off_ = kFarOff * usual_distance(distances_);
    const std::optional<Spread> spread = measure_spread(samples);
    if (spread) large_ = kLarge * spread->std;
  }

  std::vector<bool> run() {
    if (!(far_off_ > 0.0)) return found_;
    for (int round = 0; round < kRounds && look(); ++round) {
    }
    return found_;
  }

 private:
  /// One more look, given what was found; returns whether it found anything else.
  bool look() {
    const std::vector<double> errors = neighbour_errors(samples_, found_);
    std::vector<double> sizes = calm_sizes(errors, found_);
    const std::optional<TailLaw> law = TailLaw::of(sizes);
    const double limit = law ? least_outlier(errors, *law) : HUGE_VAL;
    const double loud = sizes.empty() ? 0.0 : kLoud * median(std::move(sizes));
    std::vector<bool> now(found_.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
      const bool beyond = sticks_out(errors, k) >= limit && usual_around(errors, k) <= loud;
      now[k] = distances_[k] > far_off_ || beyond;
    }
    std::swap(now, found_);
    return now != found_;
  }

  /// Size of the error where neither neighbours nor the whole signal's own size account for it.
  [[nodiscard]] double sticks_out(const std::vector<double>& errors, std::size_t k) const {
    return distances_[k] > large_ ? std::abs(errors[k]) : 0.0;
  }

  /// The smallest size such that at most kByChance of those at or above it are expected by chance.
  [[nodiscard]] double least_outlier(const std::vector<double>& errors, const TailLaw& law) const {
    std::vector<double> sizes;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (const double size = sticks_out(errors, k); size > 0.0) sizes.push_back(size);
    }
    std::sort(sizes.begin(), sizes.end());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const auto beyond = static_cast<double>(sizes.size() - i);
      if (law.expected_beyond(sizes[i]) <= kByChance * beyond) return sizes[i];
    }
    return HUGE_VAL;
  }

  const Samples& samples_;
  std::vector<double> distances_;
  std::vector<bool> found_;
  double far_off_ = 0.0;
  double large_ = 0.0;
};

/// An outlier of one or a few samples in a row.
struct Run {
  std::size_t first = 0;
  std::size_t last = 0;
};

std::vector<Run> runs_of(const std::vector<bool>& marked) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < marked.size(); ++k) {
    if (!marked[k]) continue;
    if (k == 0 || !marked[k - 1]) runs.push_back({k, k});
    runs.back().last = k;
  }
  return runs;
}

/// Where a straight line between the samples beside the run is at sample k.
double between(const Samples& samples, const Run& run, std::size_t k) {
  const double before = samples[run.first - 1];
  const double after = samples[run.last + 1];
  const auto at = static_cast<double>(k - run.first + 1);
  return before + (after - before) * at / static_cast<double>(run.last - run.first + 2);
}

/// Whether at most half of the run's height was foreseen. Its best sample counts: the first of an
/// outlier foretells the second.
bool unforeseen(const LoopPrediction& prediction, const Samples& past, const Run& run) {
  double height = 0.0;
  double error = 0.0;
  for (std::size_t k = run.first; k <= run.last; ++k) {
    const double off = prediction.error(past, k);
    if (std::isnan(off)) return true;
    height = std::max(height, std::abs(past[k] - between(past, run, k)));
    error = std::max(error, std::abs(off));
  }
  return error >= kUnforeseen * height;
}

/// Unmarks what the loop's own past foretells. Outliers are bridged in the past of what follows:
/// the loop answers them too.
void keep_own_answers(const Samples& pv, const LoopPrediction& prediction,
                      std::vector<bool>& found) {
  Samples past = pv;
  for (const Run& run : runs_of(found)) {
    const bool outlier = unforeseen(prediction, past, run);
    for (std::size_t k = run.first; k <= run.last; ++k) {
      found[k] = outlier;
      if (outlier) past[k] = between(pv, run, k);
    }
  }
}

}  // namespace

std::vector<bool> find_spikes(const Samples& pv, const Samples& op, const Samples& sp) {
  std::vector<bool> found = SpikeSearch(pv).run();
  if (runs_of(found).empty()) return found;
  keep_own_answers(pv, LoopPrediction(pv, op, sp, found), found);
  const bool too_many =
      static_cast<double>(runs_of(found).size()) > kMostSpikes * static_cast<double>(pv.size());
  return too_many ? std::vector<bool>(pv.size(), false) : found;
}

}  // namespace loopscope::core::signal
