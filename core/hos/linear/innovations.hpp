#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/hos/linear/linear_model.hpp"

namespace loopscope::core::hos {

/// What drives a record that is the output of a linear process: the part of each sample that the
/// samples before it do not predict, and how loud it is around there.
class Innovations {
 public:
  /// By Burg's method. nullopt where LinearModel::fit() has no model or leaves no error above 0.
  [[nodiscard]] static std::optional<Innovations> of(std::span<const double> signal,
                                                     const Kernels& kernels = best_kernels(),
                                                     const OrderChoice& order = {});
  /// Of the same record by weighted least squares, twice over. Burg's method gives the loudest
  /// bursts nearly all the weight and fits them too well: surrogates driven by its innovations have
  /// less of everything than the record, and a test against them is a 20 % test (DECISIONS.md).
  [[nodiscard]] Innovations reweighted(std::span<const double> signal,
                                       const Kernels& kernels = best_kernels()) const;

  [[nodiscard]] const LinearModel& model() const { return model_; }
  /// As long as the record, in its unit; NaN = not known.
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// Local standard deviation, as values() but never NaN, > 0, the same over blocks of kBlock: the
  /// root mean square of a block and its neighbours, and that of the whole record as if it were
  /// kPriorSamples more.
  [[nodiscard]] const std::vector<double>& scale() const { return scale_; }
  /// <scale^4> / <scale^2>^2: what coefficients scatter more than those of one loudness do, in
  /// terms of variance, and so what a penalty on them is to be multiplied by; at least 1.
  [[nodiscard]] double scatter() const;
  static constexpr std::size_t kBlock = 16;
  static constexpr double kPriorSamples = 2.0;

 private:
  Innovations(LinearModel model, std::vector<double> values);

  LinearModel model_;
  std::vector<double> values_;
  std::vector<double> scale_;
};

}  // namespace loopscope::core::hos
