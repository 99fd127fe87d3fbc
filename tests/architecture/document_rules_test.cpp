#include "tests/architecture/document_rules.hpp"

#include <gtest/gtest.h>

#include "tests/support/source_dir.hpp"

namespace loopscope::tests::architecture {
namespace {

TEST(DocumentRules, EveryPathLeadsSomewhere) {
  EXPECT_EQ(listing(check_paths(documents(), source_dir())), "");
}

TEST(DocumentRules, PathsThatLeadNowhereAreCaught) {
  const std::vector<SourceFile> documents = {
      {"core/README.md",
       "`core/README.md`, `core/diagnosis/diagnose`, `core/hos/NAME.hpp`, [hos](hos/README.md#x)\n"
       "`core/nothing.hpp`, [gone](gone.md), [far](https://example.org/x)\n"}};
  EXPECT_EQ(listing(check_paths(documents, source_dir())),
            "core/README.md:2: the link gone.md leads nowhere\n"
            "core/README.md:2: core/nothing.hpp does not exist\n");
}

}  // namespace
}  // namespace loopscope::tests::architecture
