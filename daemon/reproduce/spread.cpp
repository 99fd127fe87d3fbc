#include "daemon/reproduce/spread.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/hos/numeric/quantile.hpp"

namespace loopscope::daemon {

Spread spread_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("spread of no values");
  std::ranges::sort(values);
  const auto at = [&values](double share) { return core::hos::sample_quantile(values, share); };
  return {at(0.5), at(0.1), at(0.9), values.front(), values.back()};
}

}  // namespace loopscope::daemon
