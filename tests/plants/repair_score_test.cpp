#include "tests/plants/repair_score.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

namespace loopscope::tests::repairs {
namespace {

const std::vector<JudgedRepair> kJudged = {{Word::fixed, Word::fixed},
                                           {Word::improved, Word::unchanged},
                                           {Word::worse, std::nullopt},
                                           {Word::worse, Word::worse}};

TEST(RepairScore, CountsWhatWasSaidOfWhat) {
  const RepairScore result = score(kJudged);
  EXPECT_EQ(result.repairs, 4u);
  EXPECT_EQ(result.right, 2u);
  EXPECT_DOUBLE_EQ(result.words_right(), 0.5);
}

TEST(RepairScore, JsonHasTheKeysOfTheContract) {
  const auto json = nlohmann::json::parse(json_of(score(kJudged)));
  EXPECT_EQ(json.at("repairs"), 4);
  EXPECT_EQ(json.at("repair_words_right"), 0.5);
  EXPECT_EQ(json.at("matrix").at("improved").at("unchanged"), 1);
  EXPECT_EQ(json.at("matrix").at("worse").at("none"), 1);
}

TEST(RepairScore, NothingIsNotRight) {
  EXPECT_EQ(score({}).words_right(), 0.0);
}

TEST(RepairScore, WordsHaveNames) {
  for (const Word word : {Word::fixed, Word::improved, Word::unchanged, Word::worse})
    EXPECT_EQ(word_of(name(word)), word);
  EXPECT_FALSE(word_of("mended"));
}

}  // namespace
}  // namespace loopscope::tests::repairs
