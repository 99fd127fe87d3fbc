#include "storage/results/annotations.hpp"

#include <gmock/gmock.h>

#include "storage/results/migrate.hpp"
#include "tests/storage/results/views_fixture.hpp"
#include "tests/support/login_session.hpp"

namespace loopscope::storage {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using testing::Optional;

/// By a login that is a member of loopscope_engineer alone.
class AnnotationsTest : public ViewsTest {
 protected:
  void SetUp() override {
    ViewsTest::SetUp();
    if (!database) return;
    database->make_roles();
    migrate(settings_for(*database));
    login = database->make_login("loopscope_engineer");
    tell({{.loop = "a"}, {.loop = "b"}});
  }
  [[nodiscard]] Annotations annotations() const {
    return Annotations(settings_for(*database, login));
  }
  [[nodiscard]] std::int64_t in_an_hour() const {
    return std::stoll(value("SELECT (extract(epoch FROM now()) * 1000000)::bigint + 3600000000"));
  }
  std::string login;
};

TEST_F(AnnotationsTest, HideAndAreListedWithTheirAuthor) {
  const std::int64_t until = in_an_hour();
  EXPECT_THAT(annotations().add({"a", "suppressed", std::nullopt, until, "shutdown", "", 0}),
              Optional(0U));
  EXPECT_THAT(flagged(), ElementsAre("b"));
  const std::vector<Annotation> list = annotations().in_force();
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].loop_name, "a");
  EXPECT_EQ(list[0].kind, "suppressed");
  EXPECT_EQ(list[0].code, std::nullopt);
  EXPECT_EQ(list[0].until_us, until);
  EXPECT_EQ(list[0].reason, "shutdown");
  EXPECT_EQ(list[0].author, login);
  EXPECT_NEAR(static_cast<double>(list[0].entered_at_us), static_cast<double>(until) - 3.6e9, 6e7);
}

TEST_F(AnnotationsTest, ANewOneTakesThePlaceOfItsKind) {
  EXPECT_THAT(annotations().add({"a", "acknowledged", "valve_stiction", {}, "", "", 0}),
              Optional(0U));
  EXPECT_THAT(annotations().add({"a", "acknowledged", "valve_stiction", {}, "ordered", "", 0}),
              Optional(1U));
  EXPECT_THAT(annotations().add({"a", "acknowledged", "tight_tuning", {}, "", "", 0}), Optional(0U))
      << "about another verdict";
  EXPECT_EQ(annotations().in_force().size(), 2U);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.annotation_history WHERE state = 'withdrawn'"
                  " AND withdrawn_by = '" +
                  login + "'"),
            "1");
}

TEST_F(AnnotationsTest, AreTakenBackAllOrThoseOfAVerdict) {
  annotations().add({"a", "acknowledged", "valve_stiction", {}, "", "", 0});
  annotations().add({"a", "false_positive", "tight_tuning", {}, "", "", 0});
  annotations().add({"b", "acknowledged", "valve_stiction", {}, "", "", 0});
  EXPECT_EQ(annotations().withdraw("a", "valve_stiction"), 1U);
  EXPECT_THAT(flagged(), ElementsAre("a"));
  EXPECT_EQ(annotations().withdraw("a", std::nullopt), 1U);
  EXPECT_EQ(annotations().withdraw("a", std::nullopt), 0U);
  EXPECT_EQ(annotations().in_force().size(), 1U);
}

TEST_F(AnnotationsTest, UnknownLoopsAreNone) {
  EXPECT_EQ(annotations().add({"x", "acknowledged", {}, {}, "", "", 0}), std::nullopt);
  EXPECT_EQ(annotations().add({"\xff", "acknowledged", {}, {}, "", "", 0}), std::nullopt);
  EXPECT_EQ(annotations().withdraw("x", {}), 0U);
  EXPECT_EQ(annotations().newest_code("x"), std::nullopt);
  EXPECT_THAT(annotations().in_force(), IsEmpty());
}

TEST_F(AnnotationsTest, KnowsWhatCanBeAnnotated) {
  EXPECT_EQ(annotations().newest_code("a"), "valve_stiction");
  EXPECT_THAT(annotations().fault_codes(), Contains("valve_stiction"));
  EXPECT_THAT(annotations().fault_codes(), Not(Contains("healthy")));
}

TEST_F(AnnotationsTest, NobodySpeaksForSomebodyElse) {
  const auto refused = [this](const std::string& sql) {
    return tests::LoginSession(database->conninfo(login)).state_of(sql);
  };
  EXPECT_EQ(refused("INSERT INTO loopscope.annotation (loop_id, kind, author) SELECT loop_id,"
                    " 'acknowledged', 'boss' FROM loopscope.loop"),
            "42501");
  annotations().add({"a", "acknowledged", {}, {}, "", "", 0});
  EXPECT_EQ(refused("UPDATE loopscope.annotation SET reason = 'other'"), "42501");
  EXPECT_EQ(refused("UPDATE loopscope.annotation SET withdrawn_by = 'boss'"), "42501");
  EXPECT_EQ(refused("INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind,"
                    " description) SELECT loop_id, now(), 'valve', 'new packing'"
                    " FROM loopscope.loop"),
            "");
}

}  // namespace
}  // namespace loopscope::storage
