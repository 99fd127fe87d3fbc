#include "tests/architecture/folder_rules.hpp"

#include <gtest/gtest.h>
#include <string>

namespace loopscope::tests::architecture {
namespace {

TEST(FolderRules, FoldersIncludeDownwardsOnly) {
  EXPECT_EQ(listing(check_folder_circles(source_files())), "");
}

TEST(FolderRules, NoFolderIsTooFull) {
  EXPECT_EQ(listing(check_folder_sizes(source_files())), "");
}

TEST(FolderRules, EveryFolderHasItsPurpose) {
  EXPECT_EQ(listing(check_folder_purposes(source_files(), documents())), "");
}

TEST(FolderRules, CirclesAreCaught) {
  const std::vector<SourceFile> files = {{"core/hos/a/x.hpp", "#include \"core/hos/b/y.hpp\"\n"},
                                         {"core/hos/b/y.hpp", "#include \"core/hos/c/z.hpp\"\n"},
                                         {"core/hos/c/z.cpp", "#include \"core/hos/a/x.hpp\"\n"},
                                         {"core/hos/d.cpp", "#include \"core/hos/a/x.hpp\"\n"}};
  EXPECT_EQ(listing(check_folder_circles(files)),
            "core/hos/a: includes in a circle: core/hos/a core/hos/b core/hos/c\n");
}

TEST(FolderRules, FullFoldersAreCaught) {
  std::vector<SourceFile> files;
  for (int i = 0; i < 31; ++i) {
    files.push_back({"core/loop/f" + std::to_string(i) + ".hpp", ""});
    files.push_back({"core/hos/kernels/f" + std::to_string(i) + ".hpp", ""});
  }
  EXPECT_EQ(listing(check_folder_sizes(files)),
            "core/hos/kernels: holds 31 files, at most 30 are allowed\n");
}

TEST(FolderRules, FoldersWithoutAPurposeAreCaught) {
  const std::vector<SourceFile> documents = {{"core/hos/README.md", "| `a/` | what it is |\n"}};
  const std::vector<SourceFile> files = {{"core/hos/a/x.hpp", ""}, {"core/hos/a/b/x.hpp", ""}};
  EXPECT_EQ(listing(check_folder_purposes(files, documents)),
            "core/hos/a/b: core/hos/README.md does not say what it is for\n");
}

}  // namespace
}  // namespace loopscope::tests::architecture
