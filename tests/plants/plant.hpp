#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/effects/generator.hpp"

namespace loopscope::tests::plants {

/// One loop of a plant before its record is made.
struct PlantLoop {
  std::string name;        ///< L001, L002, ...
  std::string record;      ///< kind of tests/effects
  std::uint64_t seed = 0;  ///< of that record
  std::string fault;       ///< the verdict that is right; empty = healthy
  double importance = 1.0;

  [[nodiscard]] bool is_faulty() const { return !fault.empty(); }
};

struct PlantSize {
  std::size_t loops = 500;
  std::size_t faulty = 25;  ///< at most `loops`
};

/// The faults in turn, what is over among kinds by lot; they stand anywhere among the loops. The
/// rest is healthy, half of it at rest and half with a moving set point. The same plant for the
/// same seed and size. Throws std::invalid_argument when more are faulty than there are.
[[nodiscard]] std::vector<PlantLoop> draw_plant(std::uint64_t seed, PlantSize size = {});

/// `stretch`: 0 = the newest window, 1 = another one, with load and noise of its own.
[[nodiscard]] effects::Record record_of(const PlantLoop& loop, std::uint64_t stretch = 0);

/// The word of the catalogue: level where the vessel integrates, else what such a time constant is
/// usually found at.
[[nodiscard]] std::string loop_type(const PlantLoop& loop, const effects::Record& record);

}  // namespace loopscope::tests::plants
