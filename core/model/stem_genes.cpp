#include "core/model/stem_genes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace loopscope::core::model {
namespace {

/// A point of the additive recurrence of powers of the root of x^10 = x + 1: such points fill the
/// nine-dimensional unit cube evenly and are the same ones every time.
class EvenPoint {
 public:
  explicit EvenPoint(std::size_t number) {
    constexpr double kRoot = 1.0757660660868371;
    double step = 1.0;
    for (double& coordinate : at_) {
      step /= kRoot;
      const double turns = step * static_cast<double>(number + 1);
      coordinate = turns - std::floor(turns);
    }
  }
  /// The next coordinate, 0 to 1.
  double share() { return at_[next_++]; }
  /// The next coordinate, even on a logarithmic scale.
  double between(double low, double high) { return low * std::pow(high / low, share()); }
  /// The next coordinate by the logistic distribution of deviation about 1: mostly near, at times
  /// far.
  double deviation() {
    const double at = std::clamp(share(), 1e-3, 1.0 - 1e-3);
    return std::log(at / (1.0 - at)) / 1.7;
  }

 private:
  std::array<double, 9> at_{};
  std::size_t next_ = 0;
};

int whole(double value) {
  return static_cast<int>(std::lround(value));
}

/// A time constant that many times as long.
double slower(double pole, double times, double highest) {
  return pole > 0.0 ? std::clamp(std::exp(std::log(pole) / times), 0.0, highest) : pole;
}

}  // namespace

StemGenes drawn_genes(ValveLaw law, double band, std::size_t number) {
  EvenPoint at(number);
  StemGenes genes;
  // S was 0.64 to 1.4 of the band of the best play in 28 loops.
  genes.band = band * at.between(0.7, 1.4);
  genes.jump_share = 0.2 + 0.8 * at.share();
  genes.between.actuator_lag_samples = at.between(0.04, 0.5);
  genes.behind_op = 2.0 * at.share() - 1.0;
  genes.slowness = std::exp(0.5 * at.deviation());
  genes.later_samples = whole(1.2 * at.deviation());
  if (law == ValveLaw::he) return genes;
  genes.between.stem_lag_samples = at.between(0.02, 0.4);
  const double speed = at.between(1e-4, 1e-2);
  genes.between.resting_speed = number % 2 == 0 ? speed : 0.0;
  return genes;
}

StemGenes varied(const StemGenes& parent, double scale, std::size_t number) {
  EvenPoint at(number);
  const auto times = [&](double reach) { return std::exp(reach * scale * at.deviation()); };
  StemGenes child = parent;
  child.band *= times(0.012);
  child.jump_share = std::clamp(child.jump_share + 0.08 * scale * at.deviation(), 0.0, 1.0);
  child.behind_op = std::clamp(child.behind_op + 0.15 * scale * at.deviation(), -1.0, 1.0);
  BetweenSamples& between = child.between;
  between.actuator_lag_samples = std::clamp(between.actuator_lag_samples * times(0.25), 0.02, 1.0);
  child.slowness *= times(0.2);
  child.second_slowness *= times(0.2);
  child.later_samples += whole(0.8 * scale * at.deviation());
  between.stem_lag_samples = std::min(between.stem_lag_samples * times(0.3), 0.6);
  between.resting_speed *= times(0.5);
  return child;
}

ValveEffect valve_of(const StemGenes& genes, ValveLaw law, double first_op) {
  const double jump = genes.jump_share * genes.band;
  const double place = first_op - genes.behind_op * 0.5 * (genes.band + jump);
  return ValveEffect(Valve{law, genes.band, jump, 1.0, genes.between, place});
}

ProcessShape process_of(const StemGenes& genes, ProcessShape start) {
  if (!start.integrating) start.pole = slower(start.pole, genes.slowness, 0.999);
  start.second_pole = slower(start.second_pole, genes.second_slowness, 0.995);
  const long delay = static_cast<long>(start.delay_samples) + genes.later_samples;
  start.delay_samples = static_cast<std::size_t>(std::max(1L, delay));
  start.numerator = {1.0, 0.0};
  return start;
}

}  // namespace loopscope::core::model
