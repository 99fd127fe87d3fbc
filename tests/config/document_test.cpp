#include "config/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Document, TreeHasTheFilesValuesInItsOrder) {
  const Document document =
      read_document(R"({"b": [1, -2, 2.5, true, null, {"x": "y"}], "a": {}})");
  EXPECT_TRUE(document.readable);
  EXPECT_THAT(document.problems, IsEmpty());
  EXPECT_EQ(document.root.dump(), R"({"b":[1,-2,2.5,true,null,{"x":"y"}],"a":{}})");
}

TEST(Document, RepeatedKeysAreProblemsAtAnyDepth) {
  const Document document =
      read_document(R"({"a": 1, "h": [{"n": 1}, {"n": 1, "n": {"n": 2}}], "a": 3})");
  EXPECT_TRUE(document.readable);
  EXPECT_THAT(document.problems,
              ElementsAre(Field(&Problem::path, "/h/1/n"), Field(&Problem::path, "/a")));
}

TEST(Document, SameKeyInTwoObjectsIsNoRepetition) {
  EXPECT_THAT(read_document(R"({"a": {"n": 1}, "b": {"n": 1}})").problems, IsEmpty());
}

TEST(Document, RepeatedKeysAreSeenWhenWrittenDifferently) {
  EXPECT_THAT(read_document(R"({"poll": 1, "p\u006fll": 2})").problems, SizeIs(1));
}

TEST(Document, NestingIsBounded) {
  const std::string deep(100000, '[');
  const Document document = read_document(deep);
  EXPECT_FALSE(document.readable);
  EXPECT_THAT(document.problems, ElementsAre(Field(&Problem::message, "is nested too deeply")));
}

TEST(Document, PathsEscapeTheirSeparators) {
  EXPECT_EQ(member_path("/a", "b/c~d"), "/a/b~1c~0d");
}

}  // namespace
}  // namespace loopscope::config::tests
