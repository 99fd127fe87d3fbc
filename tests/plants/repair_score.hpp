#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tests/plants/repair.hpp"

namespace loopscope::tests::repairs {

/// What was said of one repair; nullopt = nothing could be said.
struct JudgedRepair {
  Word truth = Word::unchanged;
  std::optional<Word> said;
};

/// The word of that name; nullopt = there is none.
[[nodiscard]] std::optional<Word> word_of(std::string_view name);

/// How often each word was said of each truth.
struct RepairScore {
  std::size_t repairs = 0;
  std::size_t right = 0;
  /// [truth][said]; the last column is "nothing was said".
  std::array<std::array<std::size_t, kWords + 1>, kWords> matrix{};

  /// Share of right words, 0 to 1.
  [[nodiscard]] double words_right() const;
};

[[nodiscard]] RepairScore score(std::span<const JudgedRepair> repairs);

/// A table for people; one JSON object for scripts (`repairs`, `repair_words_right`, `matrix`).
[[nodiscard]] std::string table_of(const RepairScore& score);
[[nodiscard]] std::string json_of(const RepairScore& score);

}  // namespace loopscope::tests::repairs
