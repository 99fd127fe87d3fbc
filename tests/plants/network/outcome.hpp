#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/plant/shared_oscillation.hpp"
#include "core/plant/source_evidence.hpp"
#include "tests/plants/network/diagnosed.hpp"

namespace loopscope::tests::network {

/// What core/plant made of one plant.
struct Outcome {
  std::uint64_t seed = 0;
  Origin origin = Origin::valve;
  std::string source;    ///< the true one; empty = outside
  std::string named;     ///< by the program; empty = none
  bool found = false;    ///< an event that holds most of the true carriers
  std::size_t rank = 0;  ///< of the true source in that event, 1 = first; 0 = not a member
  std::size_t events = 0;
  std::size_t carriers = 0;           ///< loops that carry the oscillation
  std::size_t carriers_found = 0;     ///< of them in the event
  std::size_t members = 0;            ///< of the event
  std::size_t untouched = 0;          ///< of them that the cause does not touch
  std::size_t victims_listed = 0;     ///< carriers without a fault that stay on the work list
  std::size_t own_valves = 0;         ///< members, not the source, whose own valve sticks
  std::size_t own_valves_hidden = 0;  ///< of them those that leave the work list
  std::size_t cascades = 0;
  std::size_t cascades_found = 0;
  std::size_t cascades_false = 0;
  double plant_ms = 0.0;  ///< of core/plant

  /// One member of the event as the ranking weighs it.
  struct Figures {
    bool is_source = false;
    std::array<double, core::plant::kSourceFigures> values{};
  };
  std::vector<Figures> figures;  ///< empty unless asked for
  std::array<double, core::plant::kNoneFigures> none{};
  /// Per criterion of criteria.hpp: 1 where it alone ranks the true source first, the share of the
  /// first place where several tie. Empty unless asked for.
  std::vector<double> by_criterion;
};

/// What is worked out beside the judgement.
struct Extras {
  bool criteria = false;
  bool figures = false;
};

/// Draws, diagnoses and judges one plant.
[[nodiscard]] Outcome run_plant(std::uint64_t seed, Origin origin, Extras extras);

}  // namespace loopscope::tests::network
