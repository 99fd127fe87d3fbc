#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/simulate/calibration_families.hpp"

namespace loopscope::daemon {

/// Simulated plants on which false-discovery control is measured.
struct PlantSettings {
  std::size_t plants = 0;
  std::size_t loops = 10'000;                          ///< of a plant
  std::array<double, 2> fault_shares = {0.02, 0.001};  ///< each plant is judged at each of them
  double rate = 0.05;                                  ///< of false discoveries that is asked for
};

/// p-values of a plant's candidates, NaN where there is none. The loops come from the families of
/// their kind in turn (healthy: linear Gaussian; faulty: nonlinear).
struct PlantPool {
  std::vector<double> healthy;  ///< as many as the plant has loops
  std::vector<double> faulty;   ///< as many as the largest fault share asks for
};

/// A figure over plants.
struct PlantMean {
  double mean = 0.0;
  double standard_error = 0.0;  ///< of the mean; 0 for one plant
};

/// Loops of one family in all plants.
struct FamilyFlags {
  std::size_t loops = 0;
  std::size_t flagged = 0;
};

/// All plants at one share of faulty loops.
struct PlantSummary {
  double fault_share = 0.0;
  std::size_t plants = 0;
  std::size_t loops = 0;     ///< of a plant
  std::size_t faulty = 0;    ///< of them
  std::size_t untested = 0;  ///< loops without a p-value, in all plants
  PlantMean flags;           ///< flagged loops of a plant
  PlantMean false_share;     ///< healthy loops among the flagged; 0 where none is flagged
  PlantMean found_share;     ///< flagged loops among the faulty
  std::map<std::string, FamilyFlags> families;
};

/// p-value of one record, NaN = not computed.
using RecordP = std::function<double(std::span<const double> signal)>;

/// Draws every loop of every plant afresh, in `threads` (>= 1) threads, and asks `make_p()` (one
/// per thread) for its p-value. `loop_done` is called after every loop, never from two threads at
/// once.
[[nodiscard]] std::vector<PlantPool> draw_plants(const PlantSettings& settings, std::size_t threads,
                                                 const std::function<RecordP()>& make_p,
                                                 const std::function<void()>& loop_done);

/// Loops that draw_plants() draws.
[[nodiscard]] std::size_t drawn_loops(const PlantSettings& settings);

/// Benjamini-Hochberg over every plant, once per fault share: the faulty loops take the place of
/// the last healthy ones, so that both shares use the same pool. `pools` as draw_plants() gave them
/// for the same settings, one at least.
[[nodiscard]] std::vector<PlantSummary> judge_plants(const PlantSettings& settings,
                                                     std::span<const PlantPool> pools);

}  // namespace loopscope::daemon
