#include "core/model/products.hpp"

#include "core/model/lane_kernel.hpp"

namespace loopscope::core::model {
namespace {

Eigen::MatrixXd table(std::size_t rows, std::size_t columns) {
  return {static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns)};
}

}  // namespace

Eigen::MatrixXd products(std::span<const Signal> left, std::span<const Signal> right,
                         std::span<const Range> rows) {
  Eigen::MatrixXd all = table(left.size(), right.size());
  best_lane_kernel().fill_products({left, right, rows, false}, all);
  return all;
}

Eigen::MatrixXd products(std::span<const Signal> signals, std::span<const Range> rows) {
  Eigen::MatrixXd all = table(signals.size(), signals.size());
  best_lane_kernel().fill_products({signals, signals, rows, true}, all);
  return all.selfadjointView<Eigen::Lower>();
}

double sum_of_squares(Signal signal, std::span<const Range> rows) {
  Eigen::MatrixXd sum(1, 1);
  best_lane_kernel().fill_products({{&signal, 1}, {&signal, 1}, rows, true}, sum);
  return sum(0, 0);
}

}  // namespace loopscope::core::model
