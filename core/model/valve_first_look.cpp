#include "core/model/valve_first_look.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace loopscope::core::model {
namespace {

/// Law and J / S of the first look. Once positions are put right J is nearly flat, but for He's
/// valve, which a wrong J leads astray at every slip.
struct ValveShape {
  ValveLaw law;
  double jump_share;
};
constexpr std::array<ValveShape, 9> kShapes = {{{ValveLaw::choudhury, 0.1},
                                                {ValveLaw::choudhury, 0.6},
                                                {ValveLaw::kano, 0.1},
                                                {ValveLaw::kano, 0.5},
                                                {ValveLaw::kano, 1.0},
                                                {ValveLaw::he, 0.1},
                                                {ValveLaw::he, 0.4},
                                                {ValveLaw::he, 0.7},
                                                {ValveLaw::he, 1.0}}};
constexpr std::array<ValveShape, 3> kFirstShapes = {
    {{ValveLaw::kano, 0.1}, {ValveLaw::kano, 0.7}, {ValveLaw::choudhury, 0.4}}};

/// Of op's span: below this a valve hides in any record's noise.
constexpr double kSmallestBand = 0.03;
constexpr double kFineBandStep = 1.08;
constexpr double kFirstStep = 1.25;
/// Samples to a row: fast processes need every sample, slow noisy ones show in means.
constexpr std::size_t kFirstRowLength = 2;
constexpr std::array<std::size_t, 2> kOtherRowLengths = {1, 4};
constexpr std::size_t kBandsAtAllRates = 4;
/// Bands of the printed valve, and as many of the others, that are tracked twice.
constexpr std::size_t kLookedAtAgain = 10;
/// Bands that every law is tried around, and how far, in logarithms: half a first step and a bit.
constexpr std::size_t kBandsFollowed = 5;
constexpr double kFollowedWidth = 0.17;

/// The printed chart holds a noisy valve where the other two let it go: it has bands of its own.
bool is_printed(const Trial& trial) {
  return trial.valve.law == ValveLaw::choudhury;
}
bool is_other(const Trial& trial) {
  return !is_printed(trial);
}
bool is_any(const Trial&) {
  return true;
}

Valve valve_of(const ValveShape& shape, double band) {
  return {shape.law, band, shape.jump_share * band, 1.0};
}

std::vector<double> bands_of(const ValveRecords& records) {
  std::vector<double> bands;
  for (double band = kSmallestBand * records.op_span(); band < records.op_span();
       band *= kFineBandStep) {
    if (std::isfinite(period_of(records, valve_of(kShapes[0], band)))) {
      bands.push_back(band);
    }
  }
  return bands;
}

/// From the process that the law alone gives: under stiction the linear fit is far off (it is half
/// the controller's); that of a valve of about the right band is not.
void try_alone(ValveRecords& records, std::size_t samples_per_row, const Valve& valve, int passes,
               std::vector<Trial>& trials) {
  auto& entry = records.quick(samples_per_row);
  if (fittable(entry)) {
    trials.push_back(judge(records, entry, valve, fit_untracked(entry.record, valve), passes));
  }
}

/// The leaders once more, each from the process that it was tracked to.
void look_again(ValveRecords& records, std::vector<Trial>& trials) {
  auto& entry = records.quick(kFirstRowLength);
  for (const auto& wanted : {is_printed, is_other}) {
    for (const Trial& trial : leading(trials, kLookedAtAgain, wanted)) {
      trials.push_back(judge(records, entry, trial.valve, trial.tracked.model, 1));
    }
  }
}

void try_widely(ValveRecords& records, FirstLook& look) {
  double next = 0.0;
  for (const double band : look.bands) {
    if (band < next) {
      continue;
    }
    next = band * kFirstStep;
    for (const ValveShape& shape : kFirstShapes) {
      try_alone(records, kFirstRowLength, valve_of(shape, band), 1, look.trials);
    }
  }
  look_again(records, look.trials);
}

void choose_rate(ValveRecords& records, FirstLook& look) {
  const std::vector<Trial> best = leading(look.trials, kBandsAtAllRates, is_any);
  for (const std::size_t samples : kOtherRowLengths) {
    for (const Trial& trial : best) {
      try_alone(records, samples, trial.valve, 2, look.trials);
    }
  }
  const auto first = std::ranges::min_element(look.trials, better);
  look.samples_per_row = first != look.trials.end() ? first->samples_per_row : 1;
}

bool followed(const std::vector<Trial>& around, double band) {
  return std::ranges::any_of(around, [&](const Trial& trial) {
    return std::abs(std::log(band / trial.valve.stickband_percent)) < kFollowedWidth;
  });
}

void try_every_law(ValveRecords& records, FirstLook& look) {
  auto& entry = records.quick(look.samples_per_row);
  const std::vector<Trial> printed = leading(look.trials, kBandsFollowed, is_printed);
  const std::vector<Trial> others = leading(look.trials, kBandsFollowed, is_other);
  std::erase_if(look.trials,
                [&](const Trial& trial) { return trial.samples_per_row != look.samples_per_row; });
  for (const double band : look.bands) {
    for (const ValveShape& shape : kShapes) {
      if (followed(shape.law == ValveLaw::choudhury ? printed : others, band)) {
        look.trials.push_back(judge(records, entry, valve_of(shape, band), entry.model, 1));
      }
    }
  }
}

}  // namespace

FirstLook look_first(ValveRecords& records) {
  FirstLook look;
  look.bands = bands_of(records);
  try_widely(records, look);
  choose_rate(records, look);
  try_every_law(records, look);
  std::ranges::sort(look.trials, better);
  return look;
}

}  // namespace loopscope::core::model
