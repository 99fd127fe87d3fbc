#include "core/simulate/calibration_families.hpp"

#include <charconv>
#include <iterator>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/disturbances.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "core/simulate/missing_samples.hpp"
#include "core/simulate/paper_loops.hpp"
#include "core/simulate/paper_signals.hpp"

namespace loopscope::core::simulate {
namespace {

using Families = std::vector<CalibrationFamily>;
using Draw = decltype(CalibrationFamily::draw);

/// Shortest text that reads back as the number: "0.9", "130".
std::string text(double number) {
  char digits[32];
  return {digits, std::to_chars(std::begin(digits), std::end(digits), number).ptr};
}

Draw coloured(const AllPole& filter, Innovation law = Innovation::gaussian) {
  return [=](std::size_t samples, std::uint64_t seed) {
    return coloured_noise(filter, law, samples, seed);
  };
}

Draw cycling(const LimitCycle& cycle) {
  return [=](std::size_t samples, std::uint64_t seed) { return limit_cycle(cycle, samples, seed); };
}

/// The control error of a loop that starts anew for every record.
Draw error_of(const LoopSettings& settings) {
  return [=](std::size_t samples, std::uint64_t seed) {
    LoopSettings loop = settings;
    loop.recorded_samples = samples;
    return control_error(simulate_loop(loop, seed));
  };
}

Families noises() {
  constexpr FamilyKind kKind = FamilyKind::linear_gaussian;
  Families list = {
      {"white", "white Gaussian noise", kKind, 4096, coloured(real_pole(0.0))},
      {"ar1_0.9", "AR(1), pole 0.9", kKind, 4096, coloured(real_pole(0.9))},
      {"ar1_0.99", "AR(1), pole 0.99", kKind, 4096, coloured(real_pole(0.99))},
      {"random_walk", "sum of white noise", kKind, 4096, coloured(real_pole(1.0))},
  };
  for (const auto& [period, radius] : {std::pair{20.0, 0.97}, std::pair{20.0, 0.99},
                                       std::pair{200.0, 0.99}, std::pair{200.0, 0.995}}) {
    list.push_back({"resonance_" + text(period) + "_pole_" + text(radius),
                    "AR(2), period " + text(period) + " samples, poles of modulus " + text(radius),
                    kKind, 4096, coloured(resonance(period, radius))});
  }
  return list;
}

Families sinusoids() {
  Families list;
  // 16 and 32 divide the hop of the paper's segments, so that the line keeps its phase in all.
  for (const double period : {16.0, 20.0, 32.0, 300.0}) {
    for (const double snr_db : {0.0, 20.0}) {
      list.push_back({"sinusoid_" + text(period) + "_at_" + text(snr_db) + "_db",
                      "strict sinusoid of period " + text(period) + " in white noise, SNR " +
                          text(snr_db) + " dB",
                      FamilyKind::linear_gaussian, 4096,
                      cycling({.shape = WaveShape::sine,
                               .period_samples = period,
                               .snr_db = snr_db,
                               .jitter_rad = 0.0})});
    }
  }
  return list;
}

Families linear_examples() {
  constexpr FamilyKind kKind = FamilyKind::linear_gaussian;
  return {
      {"paper_4_1_linear", "narrow-band noise (eq. 15)", kKind, 4096, narrow_band_linear},
      {"paper_4_2_linear", "two sinusoids in noise (eq. 17)", kKind, 4096, two_sinusoids_linear},
      {"paper_5_1", "well tuned loop", kKind, 4096, error_of(well_tuned_loop())},
      {"paper_5_2_printed", "loop with I = 0.06", kKind, 4096, error_of(printed_integral_loop())},
      {"paper_5_2_excessive", "loop with I = 0.375, near instability", kKind, 4096,
       error_of(excessive_integral_loop())},
      {"paper_5_3", "loop with a sinusoid from outside", kKind, 4096,
       error_of(outside_sinusoid_loop())},
  };
}

/// The linear Gaussian `draw` with 40 % missing in ten gaps.
Draw gapped(const Draw& draw) {
  return [=](std::size_t samples, std::uint64_t seed) {
    return with_gaps(draw(samples, seed), 0.4, 10, ~seed);
  };
}

Families damaged() {
  constexpr FamilyKind kKind = FamilyKind::linear_gaussian;
  const Draw white = coloured(real_pole(0.0));
  const Draw red = coloured(real_pole(0.9));
  const Draw spiked = [white](std::size_t samples, std::uint64_t seed) {
    return with_masked_spikes(white(samples, seed), 20, ~seed);
  };
  return {
      {"white_gaps", "white noise, 40 % missing in 10 gaps", kKind, 4096, gapped(white)},
      {"ar1_0.9_gaps", "AR(1) 0.9, 40 % missing in 10 gaps", kKind, 4096, gapped(red)},
      {"white_spikes_masked", "white noise, 20 spikes masked", kKind, 4096, spiked},
      {"white_1000", "white noise, 1000 samples", kKind, 1000, white},
      {"ar1_0.9_1000", "AR(1) 0.9, 1000 samples", kKind, 1000, red},
  };
}

Families linear_non_gaussian() {
  Families list;
  for (const Innovation law : {Innovation::exponential, Innovation::uniform, Innovation::laplace}) {
    const std::string words = std::string(name(law)) + " innovations";
    const std::string end = "_" + std::string(name(law));
    for (const auto& [prefix, start, filter] :
         {std::tuple{"white", "white, ", real_pole(0.0)},
          std::tuple{"ar1_0.9", "AR(1) 0.9, ", real_pole(0.9)},
          std::tuple{"resonance_20_pole_0.97", "AR(2), period 20, ", resonance(20.0, 0.97)}}) {
      list.push_back({prefix + end, start + words, FamilyKind::linear_non_gaussian, 4096,
                      coloured(filter, law)});
    }
  }
  return list;
}

/// Noise as plants have it, in the loops that it fools tests in.
Families plant_noise() {
  struct Case {
    Innovation law = Innovation::gaussian;
    const char* loop = "";
    const char* words = "";
    AllPole filter;
    std::size_t samples = 4096;
  };
  const AllPole swinging = resonance(20.0, 0.97);
  const Case cases[] = {
      {Innovation::student_5, "white", "white", real_pole(0.0)},
      {Innovation::student_5, "ar1_0.9", "AR(1) 0.9", real_pole(0.9)},
      {Innovation::student_5, "resonance_20_pole_0.97", "AR(2), period 20", swinging},
      {Innovation::student_5, "ar1_0.8_1500", "AR(1) 0.8, 1500 samples", real_pole(0.8), 1500},
      {Innovation::student_5, "ar1_0.9_700", "AR(1) 0.9, 700 samples", real_pole(0.9), 700},
      {Innovation::student_3, "ar1_0.9", "AR(1) 0.9", real_pole(0.9)},
      {Innovation::contaminated, "ar1_0.7", "AR(1) 0.7", real_pole(0.7)},
      {Innovation::bursts, "white", "white", real_pole(0.0)},
      {Innovation::bursts, "ar1_0.9", "AR(1) 0.9", real_pole(0.9)},
      {Innovation::bursts, "resonance_20_pole_0.97", "AR(2), period 20", swinging},
      {Innovation::bursts, "ar1_0.9_700", "AR(1) 0.9, 700 samples", real_pole(0.9), 700},
      {Innovation::garch, "ar1_0.9", "AR(1) 0.9", real_pole(0.9)},
      {Innovation::garch, "resonance_20_pole_0.97", "AR(2), period 20", swinging},
  };
  Families list;
  for (const Case& one : cases) {
    const std::string law(name(one.law));
    list.push_back({std::string(one.loop) + "_" + law,
                    std::string(one.words) + ", " + law + " innovations",
                    FamilyKind::linear_non_gaussian, one.samples, coloured(one.filter, one.law)});
  }
  return list;
}

/// AR(1) 0.9 noise made louder by `factor` from one share of the record to another.
Draw louder(double from, double to, double factor) {
  return [=](std::size_t samples, std::uint64_t seed) {
    return with_level(coloured_noise(real_pole(0.9), Innovation::gaussian, samples, seed), from, to,
                      factor);
  };
}

Families disturbed() {
  constexpr FamilyKind kKind = FamilyKind::linear_disturbed;
  const Draw upset = [](std::size_t samples, std::uint64_t seed) {
    return with_step(coloured_noise(real_pole(0.9), Innovation::gaussian, samples, seed), 0.5,
                     12.0);
  };
  const Draw integrated = [](std::size_t samples, std::uint64_t seed) {
    return running_sum(coloured_noise(real_pole(1.0), Innovation::gaussian, samples, seed));
  };
  return {
      {"ar1_0.9_half_twice", "AR(1) 0.9, second half twice as loud", kKind, 4096,
       louder(0.5, 1.0, 2.0)},
      {"ar1_0.9_tenth_thrice", "AR(1) 0.9, a tenth three times as loud", kKind, 4096,
       louder(0.5, 0.6, 3.0)},
      {"ar1_0.9_one_step", "AR(1) 0.9, one step of five standard deviations", kKind, 4096, upset},
      {"integrated_walk", "sum of a random walk", kKind, 4096, integrated},
  };
}

Families nonlinear_examples() {
  constexpr FamilyKind kKind = FamilyKind::nonlinear;
  return {
      {"paper_4_1_nonlinear", "narrow band and 10 % of its square (eq. 16)", kKind, 4096,
       narrow_band_squared},
      {"paper_4_2_nonlinear", "two sinusoids and 5 % of their square (eq. 18)", kKind, 4096,
       two_sinusoids_squared},
      {"paper_5_4", "stiction S = 3, J = 1, figure 6", kKind, 4096,
       error_of(sticking_loop(StictionLaw::choudhury))},
      {"paper_5_4_kano", "stiction S = 3, J = 1, Kano's law", kKind, 4096,
       error_of(sticking_loop(StictionLaw::kano))},
  };
}

Families limit_cycles() {
  Families list;
  for (const WaveShape shape : {WaveShape::square, WaveShape::triangle, WaveShape::sawtooth,
                                WaveShape::asymmetric_square}) {
    for (const double period : {16.0, 30.0, 64.0, 130.0, 400.0}) {
      list.push_back({std::string(name(shape)) + "_" + text(period),
                      std::string(name(shape)) + " wave of period " + text(period) +
                          " at 10 dB, phase jitter 0.1 rad per root cycle",
                      FamilyKind::nonlinear, 4096,
                      cycling({.shape = shape, .period_samples = period})});
    }
  }
  return list;
}

/// In noise as plants have it, and in records as most archives give.
Families limit_cycles_in_plant_noise() {
  Families list;
  for (const WaveShape shape : {WaveShape::square, WaveShape::triangle, WaveShape::sawtooth}) {
    for (const Innovation law : {Innovation::student_5, Innovation::bursts}) {
      for (const double period : {30.0, 130.0}) {
        list.push_back(
            {std::string(name(shape)) + "_" + text(period) + "_" + std::string(name(law)),
             std::string(name(shape)) + " wave of period " + text(period) + " at 10 dB over " +
                 std::string(name(law)) + " noise",
             FamilyKind::nonlinear, 4096,
             cycling({.shape = shape, .period_samples = period, .noise = law})});
      }
    }
    for (const double period : {10.0, 40.0}) {
      list.push_back(
          {std::string(name(shape)) + "_" + text(period) + "_700",
           std::string(name(shape)) + " wave of period " + text(period) + " at 10 dB, 700 samples",
           FamilyKind::nonlinear, 700, cycling({.shape = shape, .period_samples = period})});
    }
  }
  return list;
}

}  // namespace

std::string_view name(FamilyKind kind) {
  switch (kind) {
    case FamilyKind::linear_gaussian:
      return "linear_gaussian";
    case FamilyKind::linear_non_gaussian:
      return "linear_non_gaussian";
    case FamilyKind::linear_disturbed:
      return "linear_disturbed";
    case FamilyKind::nonlinear:
      return "nonlinear";
  }
  throw std::invalid_argument("calibration: unknown kind of family");
}

const std::vector<CalibrationFamily>& calibration_families() {
  static const Families families = [] {
    Families list;
    for (const auto& part :
         {noises(), sinusoids(), linear_examples(), damaged(), linear_non_gaussian(), plant_noise(),
          disturbed(), nonlinear_examples(), limit_cycles(), limit_cycles_in_plant_noise()}) {
      list.insert(list.end(), part.begin(), part.end());
    }
    return list;
  }();
  return families;
}

}  // namespace loopscope::core::simulate
