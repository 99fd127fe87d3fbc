#include "core/signal/order/median.hpp"

#include "core/signal/order/order_statistic.hpp"

namespace loopscope::core::signal {

double median(std::span<const double> values) {
  return order_statistic(values, values.size() / 2);
}

}  // namespace loopscope::core::signal
