#include "tests/plants/repair_score.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace loopscope::tests::repairs {
namespace {

constexpr std::array kAll = {Word::fixed, Word::improved, Word::unchanged, Word::worse};

}  // namespace

std::optional<Word> word_of(std::string_view text) {
  for (const Word word : kAll)
    if (name(word) == text) return word;
  return std::nullopt;
}

double RepairScore::words_right() const {
  return repairs == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(repairs);
}

RepairScore score(std::span<const JudgedRepair> repairs) {
  RepairScore result;
  for (const JudgedRepair& repair : repairs) {
    const std::size_t said = repair.said ? static_cast<std::size_t>(*repair.said) : kWords;
    ++result.repairs;
    ++result.matrix.at(static_cast<std::size_t>(repair.truth)).at(said);
    if (repair.said == repair.truth) ++result.right;
  }
  return result;
}

std::string table_of(const RepairScore& score) {
  std::string table = fmt::format("{:<12}", "truth");
  for (const Word said : kAll) table += fmt::format("{:>11}", name(said));
  table += fmt::format("{:>11}\n", "none");
  for (const Word truth : kAll) {
    table += fmt::format("{:<12}", name(truth));
    for (const std::size_t count : score.matrix.at(static_cast<std::size_t>(truth)))
      table += fmt::format("{:>11}", count);
    table += "\n";
  }
  return table +
         fmt::format("{} of {} right, {:.3f}\n", score.right, score.repairs, score.words_right());
}

std::string json_of(const RepairScore& score) {
  nlohmann::ordered_json json{{"repairs", score.repairs},
                              {"repair_words_right", score.words_right()}};
  for (const Word truth : kAll) {
    const auto& row = score.matrix.at(static_cast<std::size_t>(truth));
    nlohmann::ordered_json& said = json["matrix"][std::string(name(truth))];
    for (const Word word : kAll)
      said[std::string(name(word))] = row.at(static_cast<std::size_t>(word));
    said["none"] = row.back();
  }
  return json.dump() + "\n";
}

}  // namespace loopscope::tests::repairs
