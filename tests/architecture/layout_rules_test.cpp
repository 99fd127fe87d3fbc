#include "tests/architecture/layout_rules.hpp"

#include <gtest/gtest.h>
#include <string>

namespace loopscope::tests::architecture {
namespace {

TEST(LayoutRules, TopLevelHasNoOtherFolder) {
  EXPECT_EQ(listing(check_top_level(top_level_folders())), "");
}

TEST(LayoutRules, EverySourceHasItsHeader) {
  EXPECT_EQ(listing(check_headers(source_files())), "");
}

TEST(LayoutRules, CoreConsistsOfRooms) {
  EXPECT_EQ(listing(check_rooms(source_files())), "");
}

TEST(LayoutRules, NoFileIsTooLong) {
  EXPECT_EQ(listing(check_lengths(source_files())), "");
}

TEST(LayoutRules, NoReadmeIsTooLong) {
  std::vector<SourceFile> readmes = documents();
  std::erase_if(readmes, [](const SourceFile& file) { return !file.path.ends_with("README.md"); });
  EXPECT_EQ(listing(check_lengths(readmes)), "");
}

TEST(LayoutRules, CheckoutIsSeen) {
  EXPECT_GT(source_files().size(), 50U);
}

TEST(LayoutRules, ForeignFolderIsCaught) {
  const std::vector<std::string> folders = {"core", "utils"};
  EXPECT_EQ(listing(check_top_level(folders)),
            "utils: no folder of this name stands at the top level\n");
}

TEST(LayoutRules, MissingHeaderIsCaught) {
  const std::vector<SourceFile> files = {{"core/hos/a.cpp", ""},
                                         {"core/hos/b.cpp", ""},
                                         {"core/hos/b.hpp", ""},
                                         {"core/hos/b_avx2.cpp", ""},
                                         {"core/hos/c_avx2.cpp", ""},
                                         {"daemon/main.cpp", ""},
                                         {"daemon/commands/x.cpp", ""},
                                         {"daemon/commands/commands.hpp", ""},
                                         {"daemon/lab/commands/y.cpp", ""},
                                         {"tests/core/d_test.cpp", ""}};
  EXPECT_EQ(listing(check_headers(files)),
            "core/hos/a.cpp: has no header core/hos/a.hpp\n"
            "core/hos/c_avx2.cpp: has no header core/hos/c_avx2.hpp\n"
            "daemon/lab/commands/y.cpp: has no header daemon/lab/commands/y.hpp\n");
}

TEST(LayoutRules, FileOutsideOfTheRoomsIsCaught) {
  const std::vector<SourceFile> files = {{"core/CMakeLists.txt", ""}, {"core/util/x.hpp", ""}};
  EXPECT_EQ(listing(check_rooms(files)), "core/util/x.hpp: stands in no room of core/\n");
}

TEST(LayoutRules, LongFileIsCaught) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += "\n";
  EXPECT_TRUE(check_lengths(std::vector<SourceFile>{{"a.hpp", text}}).empty());
  EXPECT_EQ(listing(check_lengths(std::vector<SourceFile>{{"a.hpp", text + "\n"}})),
            "a.hpp:301: has 301 lines, at most 300 are allowed\n");
  EXPECT_EQ(listing(check_lengths(std::vector<SourceFile>{{"core/README.md", text}})),
            "core/README.md:300: has 300 lines, at most 150 are allowed\n");
  const std::string three = text + text + text;
  EXPECT_EQ(listing(check_lengths(std::vector<SourceFile>{{"storage/migrations/a.sql", three}})),
            "");
  EXPECT_EQ(
      listing(check_lengths(std::vector<SourceFile>{{"storage/migrations/a.sql", three + "\n"}})),
      "storage/migrations/a.sql:901: has 901 lines, at most 900 are allowed\n");
}

TEST(LayoutRules, WideMigrationIsCaught) {
  const std::string line(120, '-');
  EXPECT_EQ(listing(check_lengths(std::vector<SourceFile>{
                {"storage/migrations/a.sql", line + "\n" + line + "-\n"}, {"b.sql", line + "-"}})),
            "storage/migrations/a.sql:2: is 121 characters wide, at most 120 are allowed\n");
}

}  // namespace
}  // namespace loopscope::tests::architecture
