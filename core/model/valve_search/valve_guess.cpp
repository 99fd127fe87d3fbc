#include "core/model/valve_search/valve_guess.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace loopscope::core::model {
namespace {

/// A point of the additive recurrence of powers of the root of x^10 = x + 1: such points fill the
/// nine-dimensional unit cube evenly and are the same ones every time.
std::array<double, kGenes> even_point(std::size_t number) {
  constexpr double kRoot = 1.0757660660868371;
  std::array<double, kGenes> at{};
  double step = 1.0;
  for (double& coordinate : at) {
    step /= kRoot;
    const double turns = step * static_cast<double>(number + 1);
    coordinate = turns - std::floor(turns);
  }
  return at;
}

/// Of the logistic distribution of deviation about 1: mostly near, at times far.
double deviation(double share) {
  const double at = std::clamp(share, 1e-3, 1.0 - 1e-3);
  return std::log(at / (1.0 - at)) / 1.7;
}

/// Speeds below it, of bands a sample, are no reason to rest.
constexpr double kSlowestRest = 1e-4;

struct Drawn {
  double low = 0.0, high = 0.0;  ///< even between them, or
  double spread = 0.0;           ///< about 0
};

/// Where first guesses lie. S was 0.64 to 1.4 of the band of the best play in 28 loops; a quarter
/// of the guesses have no second lag.
const std::array<Drawn, kGenes> kFirst{
    {{std::log(0.7), std::log(1.4), 0.0},
     {0.2, 1.0, 0.0},
     {-1.0, 1.0, 0.0},
     {std::log(0.04), std::log(0.5), 0.0},
     {0.2, 0.2, 0.5},
     {0.1, 0.1, 0.4},
     {-0.2, 0.6, 0.0},
     {std::log(0.02), std::log(0.4), 0.0},
     {2.0 * std::log(kSlowestRest) - std::log(1e-2), std::log(1e-2), 0.0}}};

/// How far a child goes by itself at scale 1, and the limits that it keeps to. Those of logarithms
/// keep exp() and the dead time finite.
struct Moved {
  double reach = 0.0;
  double low = -20.0, high = 20.0;
};

const std::array<Moved, kGenes> kMoved{{{0.012},
                                        {0.08, 0.0, 1.0},
                                        {0.15, -1.0, 1.0},
                                        {0.25, std::log(0.02), 0.0},
                                        {0.2},
                                        {0.1, -3.0, 3.0},
                                        {0.1, -0.9, 0.9},
                                        {0.3, -20.0, std::log(0.6)},
                                        {0.5}}};

double samples_of_lag(double pole) {
  return pole > 0.0 && pole < 1.0 ? -1.0 / std::log(pole) : 0.0;
}

double lag_pole(double lag_samples, double highest) {
  return lag_samples > 0.0 ? std::min(std::exp(-1.0 / lag_samples), highest) : 0.0;
}

}  // namespace

ValveGuess drawn_genes(double band, std::size_t number) {
  ValveGuess genes{even_point(number)};
  for (std::size_t i = 0; i < kGenes; ++i) {
    const Drawn& drawn = kFirst[i];
    genes.at[i] =
        drawn.low + (drawn.high - drawn.low) * genes.at[i] + drawn.spread * deviation(genes.at[i]);
  }
  genes.at[static_cast<std::size_t>(Gene::log_band)] += std::log(band);
  return genes;
}

ValveGuess varied(const ValveGuess& parent, const Way& way, double scale, std::size_t number) {
  const std::array<double, kGenes> shares = even_point(number);
  ValveGuess child = parent;
  for (std::size_t i = 0; i < kGenes; ++i) {
    const Moved& moved = kMoved[i];
    child.at[i] +=
        way.share * (way.to.at[i] - way.from.at[i]) + moved.reach * scale * deviation(shares[i]);
    child.at[i] = std::clamp(child.at[i], moved.low, moved.high);
  }
  return child;
}

ValveEffect valve_of(const ValveGuess& genes, ValveLaw law, double first_op) {
  const double band = std::exp(genes[Gene::log_band]);
  const double jump = genes[Gene::jump_share] * band;
  const double place = first_op - genes[Gene::behind_op] * 0.5 * (band + jump);
  BetweenSamples between;
  between.actuator_lag_samples = std::exp(genes[Gene::log_actuator_lag]);
  if (law == ValveLaw::kano) {
    between.stem_lag_samples = std::exp(genes[Gene::log_stem_lag]);
    const double speed = std::exp(genes[Gene::log_resting_speed]);
    between.resting_speed = speed < kSlowestRest ? 0.0 : speed;
  }
  return ValveEffect(Valve{law, band, jump, 1.0, between, place});
}

ProcessShape process_of(const ValveGuess& genes, ProcessShape start) {
  /// A process that seemed to have no lag may have a short one.
  constexpr double kShortLag = 0.5;
  if (!start.integrating) {
    const double lag = std::max(kShortLag, samples_of_lag(start.pole));
    start.pole = lag_pole(lag * std::exp(genes[Gene::log_slowness]), 0.999);
  }
  const double was_late =
      static_cast<double>(start.delay_samples) + samples_of_lag(start.second_pole);
  const double late = was_late * std::exp(genes[Gene::log_lateness]);
  const double second = late * std::max(0.0, genes[Gene::second_share]);
  start.second_pole = lag_pole(second, 0.995);
  start.delay_samples = static_cast<std::size_t>(std::max(1L, std::lround(late - second)));
  start.numerator = {1.0, 0.0};
  return start;
}

}  // namespace loopscope::core::model
