#include "storage/results/writes/model_keys.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// `taken->>'effect'`, `model::jsonb->'steps'`.
void add_keys(const std::string& sql, std::set<std::string>& keys) {
  static const std::regex key("->>?'([a-z_0-9]+)'");
  for (std::sregex_iterator hit(sql.begin(), sql.end(), key), end; hit != end; ++hit) {
    keys.insert((*hit)[1]);
  }
}

TEST(ModelKeys, AreThoseThatSqlTakesOutOfJson) {
  std::set<std::string> taken;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(tests::source_dir() / "storage")) {
    const std::string ending = entry.path().extension();
    if (ending == ".cpp" || ending == ".sql") add_keys(text_of(entry.path()), taken);
  }
  EXPECT_THAT(taken, testing::UnorderedElementsAreArray(model_keys::kAll));
}

}  // namespace
}  // namespace loopscope::storage
