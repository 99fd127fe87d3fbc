#include "daemon/calibrate/binomial_share.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <stdexcept>

namespace loopscope::daemon {

BinomialShare binomial_share(std::size_t successes, std::size_t trials) {
  if (trials == 0 || successes > trials) {
    throw std::invalid_argument("binomial share: more successes than trials, or no trial");
  }
  using Law = boost::math::binomial;
  constexpr double kEachSide = 0.025;
  const auto found = static_cast<double>(successes);
  const auto all = static_cast<double>(trials);
  return {found / all, Law::find_lower_bound_on_p(all, found, kEachSide),
          Law::find_upper_bound_on_p(all, found, kEachSide)};
}

}  // namespace loopscope::daemon
