#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tests/effects/scenario.hpp"

namespace loopscope::tests::repairs {

/// What a repair came to, by construction (README.md says what each asks of the simulation).
enum class Word { fixed, improved, unchanged, worse };
inline constexpr std::size_t kWords = 4;

[[nodiscard]] std::string_view name(Word word);

/// One loop before and after somebody worked on it. Each window is 4096 samples of its own, with
/// noise, load and set points of its own; op and mv in %, sp and pv in % of span.
struct Repair {
  std::string fault;  ///< its name in fault_kinds()
  Word word = Word::unchanged;
  std::string event_kind;  ///< valve, sensor, tuning, process, other
  std::string work;        ///< what was done, in the words of a work order
  bool integrating = false;
  double interval_s = 1.0;
  std::vector<effects::Series> before;
  std::vector<effects::Series> after;
  /// Of the error's mean square in the long run, after by before, load and noise being equal.
  double variance_ratio = 1.0;
};

/// The same repair for the same word and seed.
[[nodiscard]] Repair draw_repair(Word word, std::uint64_t seed);

}  // namespace loopscope::tests::repairs
