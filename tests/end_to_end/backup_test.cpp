#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>

#include "tests/end_to_end/plant.hpp"

/// deploy/RUNBOOK.md, "Backup and restore", with other names.
namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// What is in the schema, as one text.
constexpr const char* kContents =
    "SELECT row((SELECT count(*) FROM loopscope.loop), (SELECT count(*) FROM loopscope.analysis),"
    " (SELECT max(analysis_id) FROM loopscope.analysis),"
    " (SELECT string_agg(s::text, '|' ORDER BY loop_id) FROM loopscope.schedule AS s),"
    " (SELECT string_agg(v::text, '|' ORDER BY v::text) FROM loopscope.verdict AS v),"
    " (SELECT string_agg(a::text, '|') FROM loopscope.annotation AS a),"
    " (SELECT count(*) FROM pg_inherits WHERE inhparent = 'loopscope.analysis'::regclass))::text";

/// A plant that has worked, and a database without anything but the group roles.
class Backup : public testing::Test {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
    plant_.emplace();
    plant_->write_settings(Plant::settings(R"("schedule": {"settle_s": 0})"));
    plant_->import_simulated("FIC1", "sticking_valve", "5");
    plant_->import_loop("PIC1");
    ASSERT_EQ(plant_->loopscope("once").exit_code, 0);
    // A month that is younger than the last migrate, and an annotation that was taken back.
    plant_->sql(
        "SET ROLE loopscope_owner; SELECT loopscope.make_partitions('2020-01-01', 1);"
        "INSERT INTO loopscope.annotation (loop_id, kind) SELECT loop_id, 'acknowledged' FROM"
        " loopscope.loop WHERE name = 'FIC1'; UPDATE loopscope.annotation SET withdrawn_at = "
        "now()");
    restored_.emplace();
    restored_->make_roles();
    reader_ = restored_->make_login("loopscope_reader");
    owner_ = restored_->make_login("loopscope_owner");
    worker_ = restored_->make_login("loopscope_worker");
  }

  [[nodiscard]] std::string file() const { return plant_->folder() / "loopscope.dump"; }

  [[nodiscard]] ProgramResult dump() const {
    return run_program({"/usr/bin/pg_dump", "--format=custom", "--schema=loopscope",
                        "--file=" + file(),
                        "--dbname=" + with_key(plant_->connection(), "user", reader_)});
  }
  [[nodiscard]] ProgramResult restore() const {
    return run_program({"/usr/bin/pg_restore", "--exit-on-error", "--single-transaction",
                        "--no-owner", "--role=loopscope_owner",
                        "--dbname=" + restored_->conninfo(owner_), file()});
  }

  /// On the restored database, with the plant's historian.
  [[nodiscard]] ProgramResult loopscope(const std::string& command) const {
    const std::string settings = plant_->folder() / "restored.json";
    std::ofstream(settings) << R"({"results": {"connection": ")" << restored_->conninfo(worker_)
                            << R"(", "owner_connection": ")" << restored_->conninfo(owner_)
                            << R"("}, "historians": [{"name": "plant", "connection": ")"
                            << plant_->connection() << R"("}], "schedule": {"settle_s": 0}})";
    return run_program({LOOPSCOPE_PROGRAM, command, "--config", settings});
  }

  std::optional<Plant> plant_;
  std::optional<TestDatabase> restored_;
  std::string reader_, owner_, worker_;
};

TEST_F(Backup, AReadersDumpIsRestoredByTheOwnerAndWorkedOn) {
  const ProgramResult dumped = dump();
  ASSERT_EQ(dumped.exit_code, 0) << dumped.err;
  const ProgramResult restored = restore();
  ASSERT_EQ(restored.exit_code, 0) << restored.err;
  EXPECT_EQ(restored_->value(kContents), plant_->sql(kContents));
  EXPECT_EQ(restored_->value("SELECT count(*) FROM pg_class WHERE relnamespace ="
                             " 'loopscope'::regnamespace AND relowner <>"
                             " 'loopscope_owner'::regrole"),
            "0");
  for (const char* command : {"migrate", "check-config", "maintain"}) {
    const ProgramResult done = loopscope(command);
    EXPECT_EQ(done.exit_code, 0) << command << ": " << done.out << done.err;
  }
  const ProgramResult pass = loopscope("once");
  EXPECT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_THAT(pass.out, HasSubstr("0 new, 0 revised, 2 unchanged")) << "nothing is done twice";
}

/// A restore that is tried on a schema in use changes nothing.
TEST_F(Backup, IsNotRestoredOverASchemaThatIsThere) {
  ASSERT_EQ(dump().exit_code, 0);
  ASSERT_EQ(restore().exit_code, 0);
  const std::string before = restored_->value(kContents);
  EXPECT_NE(restore().exit_code, 0);
  EXPECT_EQ(restored_->value(kContents), before);
}

}  // namespace
}  // namespace loopscope::tests
