#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace loopscope::tests::process {

/// Balances of a plant in physical units, from its nominal state on.
class UnitProcess {
 public:
  UnitProcess() = default;
  UnitProcess(const UnitProcess&) = delete;
  UnitProcess& operator=(const UnitProcess&) = delete;
  virtual ~UnitProcess() = default;

  /// `flows` by stream, `upsets` as distances from the nominal supplies.
  virtual void step(const std::vector<double>& flows, const std::vector<double>& upsets,
                    double step_s) = 0;
  [[nodiscard]] virtual double value(std::size_t which) const = 0;
  /// Flow of a stream by its nominal one at the same valve: heads and headers.
  [[nodiscard]] virtual double drive(std::size_t) const { return 1.0; }
};

template <std::size_t count>
using State = std::array<double, count>;

/// One step of the classical Runge-Kutta method; `slope` = d state / dt.
template <std::size_t count, typename Slope>
State<count> runge_kutta(const State<count>& at, double step, Slope&& slope) {
  const auto ahead = [&at](const State<count>& rate, double by) {
    State<count> next = at;
    for (std::size_t i = 0; i < count; ++i) next[i] += by * rate[i];
    return next;
  };
  const State<count> a = slope(at);
  const State<count> b = slope(ahead(a, step / 2.0));
  const State<count> c = slope(ahead(b, step / 2.0));
  const State<count> d = slope(ahead(c, step));
  State<count> next = at;
  for (std::size_t i = 0; i < count; ++i)
    next[i] += step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  return next;
}

}  // namespace loopscope::tests::process
