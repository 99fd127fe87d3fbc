#include "core/hos/linear/stationary_stretch.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "core/hos/linear/error_moments.hpp"
#include "core/hos/linear/linear_model.hpp"

namespace loopscope::core::hos {
namespace {

/// Samples of a sub-window: 16 of them are a record, two the shortest that can be tested.
constexpr std::size_t kSubWindow = 256;

/// A change is known within half a sub-window, which neither side keeps.
constexpr std::size_t kUnsure = kSubWindow / 2;

/// Chi squared of nine, exceeded once in 15 000 times: one of 1000 records has it at one of its 15
/// splits.
constexpr double kDiffers = 34.6;
/// Less does not raise the bicoherence, however sure it is: a long cycle is cut for nothing.
constexpr double kMatters = 0.15;

/// Those of all sub-windows; the last one takes what is left over.
std::vector<ErrorMoments> moments_of(std::span<const double> errors) {
  const std::size_t count = errors.size() / kSubWindow;
  std::vector<ErrorMoments> moments;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i * kSubWindow;
    const std::size_t size = i + 1 < count ? kSubWindow : errors.size() - first;
    moments.emplace_back(errors.subspan(first, size));
  }
  return moments;
}

/// Sums from each sub-window to the last.
std::vector<ErrorMoments> sums_to_the_end(std::vector<ErrorMoments> moments) {
  for (std::size_t i = moments.size(); i-- > 1;) moments[i - 1] += moments[i];
  return moments;
}

/// The sample at which both sides differ most; nullopt when they do not differ, or too little.
std::optional<std::size_t> find_change(std::span<const double> signal) {
  const std::optional<LinearModel> model = LinearModel::fit(signal);
  if (!model) return std::nullopt;
  const std::vector<ErrorMoments> each = moments_of(model->errors(signal));
  const std::vector<ErrorMoments> after = sums_to_the_end(each);
  ErrorMoments before;
  std::optional<std::size_t> change;
  double most = kDiffers;
  for (std::size_t i = 1; i < each.size(); ++i) {
    before += each[i - 1];
    const ErrorMoments::Difference difference = before.difference_from(after[i]);
    if (difference.chi_squared <= most || difference.size <= kMatters) continue;
    most = difference.chi_squared;
    change = i * kSubWindow;
  }
  return change;
}

/// The longest part of `signal`, which starts at sample `first` of the record.
Stretch longest(std::span<const double> signal, std::size_t first) {
  const Stretch whole{first, signal.size()};
  const std::optional<std::size_t> change =
      signal.size() < 2 * kSubWindow ? std::nullopt : find_change(signal);
  if (!change) return whole;
  const Stretch left = longest(signal.first(*change - kUnsure), first);
  const std::size_t after = *change + kUnsure;
  const Stretch right = longest(signal.subspan(after), first + after);
  return left.size > right.size ? left : right;
}

}  // namespace

Stretch stationary_stretch(std::span<const double> signal) {
  return longest(signal, 0);
}

}  // namespace loopscope::core::hos
