#include "core/model/questions/time_level.hpp"

#include <cmath>

#include "core/model/phrases.hpp"
#include "core/model/questions/change_point.hpp"

namespace loopscope::core::model {
namespace {

/// A straight line through the residual (unit variance, missing samples 0).
struct Line {
  double slope_per_sample = 0.0;
  double explained = 0.0;  ///< sum of squares
};

Line line_through(const Questioned& questioned) {
  const Eigen::Index size = questioned.recorded.size();
  const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(size, 0.0, static_cast<double>(size - 1));
  const double mean = (time * questioned.recorded).sum() / questioned.recorded.sum();
  const Eigen::ArrayXd about = (time - mean) * questioned.recorded;
  const Eigen::Map<const Eigen::ArrayXd> r(questioned.residual.values.data(), size);
  const double product = (about * r).sum();
  const double squares = about.square().sum();
  return {product / squares, product * product / squares};
}

double explained_by_step(const Questioned& questioned, const ChangePoint& change) {
  const auto total = static_cast<double>(questioned.residual.recorded);
  const auto split = static_cast<Eigen::Index>(change.at_sample);
  const double before = questioned.recorded.head(split).sum();
  return before * change.before * change.before + (total - before) * change.after * change.after;
}

std::string drift_words(double slope_per_sample, const Questioned& questioned) {
  constexpr double kHour_s = 3600.0;
  const double per_hour =
      slope_per_sample * questioned.residual.std * kHour_s / questioned.view.sample_interval_s;
  return "The residual drifts by " + in_digits(per_hour) + " pv units per hour.";
}

}  // namespace

Answer ask_time_level(const Questioned& questioned) {
  const ChangePoint change = find_change(questioned.residual.values);
  Answer answer{{"time_level", change.p, {}}, {}};
  if (change.p > kSignificant) return answer;
  const Line line = line_through(questioned);
  if (line.explained > explained_by_step(questioned, change)) {
    answer.question.statement = drift_words(line.slope_per_sample, questioned);
    return answer;
  }
  const double size = (change.after - change.before) * questioned.residual.std;
  answer.question.statement = "The residual shifts by " + in_digits(size) + " pv units " +
                              at_place(change.at_sample, questioned.view.sample_interval_s) +
                              " and stays there.";
  answer.nominations = {{.effect = EffectKind::load_step,
                         .p = change.p,
                         .at_sample = change.at_sample,
                         .size = size}};
  return answer;
}

}  // namespace loopscope::core::model
