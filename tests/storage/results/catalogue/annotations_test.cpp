#include "storage/results/catalogue/annotations.hpp"

#include <chrono>
#include <future>
#include <gmock/gmock.h>
#include <thread>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/views_fixture.hpp"
#include "tests/support/hostile_names.hpp"
#include "tests/support/login_session.hpp"

namespace loopscope::storage {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

MATCHER_P2(others, replaced, beside, "") {
  return arg && arg->replaced.size() == replaced && arg->beside.size() == beside;
}

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

TEST_F(AnnotationsTest, OfSeveralWhoSayTheSameAtOnceOneHolds) {
  {
    std::vector<std::jthread> people;
    for (int person = 0; person < 4; ++person)
      people.emplace_back([&] {
        annotations().add({"a", "acknowledged", "valve_stiction", std::nullopt, "x", "", 0});
      });
  }
  EXPECT_EQ(annotations().in_force().size(), 1U);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.annotation"), "4");
}

TEST_F(AnnotationsTest, HideAndAreListedWithTheirAuthor) {
  const std::int64_t until = in_an_hour();
  EXPECT_THAT(annotations().add({"a", "suppressed", std::nullopt, until, "shutdown", "", 0}),
              others(0U, 0U));
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

TEST_F(AnnotationsTest, AreMadeAndTakenBackInSomebodysName) {
  annotations().add({"a", "acknowledged", {}, {}, "ordered", "", 0, "J. Doe"});
  annotations().add({"b", "acknowledged", {}, {}, "", "", 0});
  const std::vector<Annotation> list = annotations().in_force();
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].author, login) << "as the server notes it, beside the name";
  EXPECT_EQ(list[0].on_behalf_of, "J. Doe");
  EXPECT_EQ(list[1].on_behalf_of, std::nullopt);
  EXPECT_EQ(value("SELECT author || ' for ' || on_behalf_of FROM loopscope.hidden_loop"
                  " WHERE loop_name = 'a'"),
            login + " for J. Doe");
  annotations().add({"a", "acknowledged", {}, {}, "", "", 0, "Eve"});
  EXPECT_EQ(annotations().withdraw("a", {}, "Bob"), 1U);
  EXPECT_EQ(column("SELECT on_behalf_of || ', withdrawn by ' || withdrawn_by || ' for '"
                   " || withdrawn_on_behalf_of FROM loopscope.annotation_history"
                   " WHERE loop_name = 'a' ORDER BY annotation_id"),
            (std::vector<std::string>{"J. Doe, withdrawn by " + login + " for Eve",
                                      "Eve, withdrawn by " + login + " for Bob"}));
}

TEST_F(AnnotationsTest, OneOfSeveralIsTakenBackAndOnlyOfItsLoop) {
  annotations().add({"a", "acknowledged", {}, {}, "ordered", "", 0});
  annotations().add({"a", "false_positive", "valve_stiction", {}, "", "", 0});
  annotations().add({"b", "acknowledged", {}, {}, "", "", 0});
  const std::vector<Annotation> holds = annotations().in_force("a");
  ASSERT_EQ(holds.size(), 2U);
  EXPECT_EQ(holds[0].kind, "acknowledged");
  EXPECT_TRUE(annotations().in_force("nowhere").empty());
  EXPECT_TRUE(annotations().in_force(std::string("a\0b", 3)).empty());
  EXPECT_FALSE(annotations().withdraw_one("b", holds[0].annotation_id, "Eve"));
  const auto withdrawn = annotations().withdraw_one("a", holds[0].annotation_id, "Eve");
  ASSERT_TRUE(withdrawn);
  EXPECT_EQ(withdrawn->reason, "ordered");
  EXPECT_FALSE(annotations().withdraw_one("a", holds[0].annotation_id, "Eve")) << "twice";
  EXPECT_EQ(annotations().in_force().size(), 2U);
  EXPECT_EQ(value("SELECT withdrawn_on_behalf_of FROM loopscope.annotation_history"
                  " WHERE annotation_id = " +
                  std::to_string(holds[0].annotation_id)),
            "Eve");
}

/// What the program refuses in words the database refuses too: pages and other programs will write.
TEST_F(AnnotationsTest, AHostileNameIsStoredAsItIsOrRefused) {
  const tests::LoginSession session(database->conninfo(login));
  const std::string insert =
      "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description, on_behalf_of)"
      " SELECT loop_id, now(), 'valve', 'x', ";
  const auto state_of = [&](const std::string& name) {
    return session.state_of(insert + tests::sql_text(name) +
                            " FROM loopscope.loop WHERE name = 'a'");
  };
  for (const tests::HostileName& hostile : tests::hostile_names()) {
    const std::string& name = hostile.name;
    const bool is_line = tests::is_harmless_on_a_terminal(name) &&
                         name.find('\n') == std::string::npos && name.front() != ' ' &&
                         name.back() != ' ' && name.size() <= 200;
    EXPECT_EQ(state_of(name), is_line ? "" : "23514") << hostile.about << ": " << tests::hex(name);
  }
  EXPECT_EQ(state_of(std::string(kLongestOnBehalfOf, 'x')), "");
  EXPECT_EQ(state_of(std::string(kLongestOnBehalfOf + 1, 'x')), "23514");
  EXPECT_EQ(state_of(""), "23514");
}

TEST_F(AnnotationsTest, NobodyIsNamedForAWithdrawalThatIsNone) {
  annotations().add({"a", "acknowledged", {}, {}, "", "", 0});
  tests::SqlConnection(database->conninfo(login))
      .run("UPDATE loopscope.annotation SET withdrawn_on_behalf_of = 'boss'");
  EXPECT_EQ(value("SELECT coalesce(withdrawn_on_behalf_of, state) FROM"
                  " loopscope.annotation_history"),
            "in_force");
  EXPECT_EQ(annotations().withdraw("a", {}), 1U);
  EXPECT_EQ(tests::LoginSession(database->conninfo(login))
                .state_of("UPDATE loopscope.annotation SET withdrawn_on_behalf_of = 'boss'"),
            "23514")
      << "what was taken back stays so";
}

TEST_F(AnnotationsTest, ANewOneTakesThePlaceOfItsKind) {
  EXPECT_THAT(
      annotations().add({"a", "acknowledged", "valve_stiction", {}, "seen", "", 0, "J. Doe"}),
      others(0U, 0U));
  const auto second =
      annotations().add({"a", "acknowledged", "valve_stiction", {}, "ordered", "", 0});
  EXPECT_THAT(second, others(1U, 0U));
  EXPECT_EQ(second->replaced[0].reason, "seen");
  EXPECT_EQ(second->replaced[0].on_behalf_of, "J. Doe");
  EXPECT_EQ(second->replaced[0].author, login);
  const auto third = annotations().add({"a", "acknowledged", "tight_tuning", {}, "", "", 0});
  EXPECT_THAT(third, others(0U, 1U)) << "about another verdict";
  EXPECT_EQ(third->beside[0].reason, "ordered");
  EXPECT_EQ(annotations().in_force().size(), 2U);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.annotation_history WHERE state = 'withdrawn'"
                  " AND withdrawn_by = '" +
                  login + "'"),
            "1");
  EXPECT_THAT(annotations().add({"b", "acknowledged", {}, {}, "", "", 0}), others(0U, 0U))
      << "another loop";
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

/// What one engineer has taken back, with the time given to another to say so.
TEST_F(AnnotationsTest, WhatWasTakenBackStaysSo) {
  annotations().add({"a", "suppressed", {}, in_an_hour(), "shutdown", "", 0});
  EXPECT_EQ(annotations().withdraw("a", std::nullopt), 1U);
  const std::string second = database->make_login("loopscope_engineer");
  const tests::SqlConnection other(database->conninfo(second));
  for (const char* time : {"NULL", "'1999-01-01'", "now() + interval '1 day'"}) {
    EXPECT_THROW(other.run(std::string("UPDATE loopscope.annotation SET withdrawn_at = ") + time),
                 std::runtime_error)
        << time;
  }
  EXPECT_EQ(value("SELECT state FROM loopscope.annotation_history"), "withdrawn");
  EXPECT_EQ(value("SELECT withdrawn_by FROM loopscope.annotation_history"), login);
  EXPECT_EQ(annotations().withdraw("a", std::nullopt), 0U) << "there is nothing left";
}

TEST_F(AnnotationsTest, TheServerNotesWhenOneWasTakenBack) {
  annotations().add({"a", "acknowledged", {}, {}, "", "", 0});
  tests::SqlConnection(database->conninfo(login))
      .run("UPDATE loopscope.annotation SET withdrawn_at = '1999-01-01'");
  EXPECT_EQ(value("SELECT withdrawn_at >= entered_at AND withdrawn_at <= now()"
                  " FROM loopscope.annotation_history"),
            "t");
}

TEST_F(AnnotationsTest, TwoWhoTakeTheSameOneBackTakeItBackOnce) {
  annotations().add({"a", "acknowledged", {}, {}, "", "", 0});
  const tests::SqlConnection other(database->conninfo(login));
  other.run("BEGIN; UPDATE loopscope.annotation SET withdrawn_at = now()");
  std::future<std::size_t> second =
      std::async(std::launch::async, [this] { return annotations().withdraw("a", std::nullopt); });
  // Until it waits for the first.
  while (value("SELECT count(*) FROM pg_locks WHERE NOT granted") == "0") {
    ASSERT_EQ(second.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  }
  other.run("COMMIT");
  EXPECT_EQ(second.get(), 0U);
}

}  // namespace
}  // namespace loopscope::storage
