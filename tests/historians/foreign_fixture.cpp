#include "tests/historians/foreign_fixture.hpp"

#include <bit>

namespace loopscope::tests {
namespace {

/// A history of five tags: one a second with rows of one time and values that are bad, one that
/// keeps still for days, one with fractions of a second, one that died in January, one never there.
constexpr const char* kHistory = R"(
    CREATE TABLE native (tag text NOT NULL, time timestamp NOT NULL, value float8, quality int);
    SELECT setseed(0.32);
    INSERT INTO native SELECT 'FIC1', timestamp '2026-03-30' - k * interval '1 second',
      random() * 1e3, CASE WHEN random() < 0.1 THEN n ELSE 192 + n END
      FROM generate_series(0, 8000) AS k, generate_series(0, (random() * 1.2)::int) AS n;
    INSERT INTO native SELECT 'SP1', timestamp '2026-03-29' - k * k * interval '1 hour',
      k / 7.0 + random(), 192 + n FROM generate_series(0, 60) AS k, generate_series(0, (random() * 2)::int) AS n;
    INSERT INTO native SELECT 'odd ''tag''',
      timestamp '2026-03-30' - (k * 1234567.0 * random()) * interval '1 microsecond',
      exp(random() * 600 - 300) - random(), CASE WHEN random() < 0.1 THEN 64 ELSE 192 END
      FROM generate_series(0, 4000) AS k;
    INSERT INTO native SELECT 'DEAD', timestamp '2026-01-05 12:00' - k * interval '0.5 second',
      k, 192 FROM generate_series(0, 500) AS k;
    CREATE INDEX ON native (tag, time))";

}  // namespace

void expect_same(const core::signal::RawSeries& read, const core::signal::RawSeries& expected,
                 const storage::TagRequest& request) {
  ASSERT_EQ(read.time_us, expected.time_us) << request.tag << request.from_us;
  for (std::size_t k = 0; k < expected.value.size(); ++k) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(read.value[k]),
              std::bit_cast<std::uint64_t>(expected.value[k]))
        << request.tag << k;
  }
  EXPECT_EQ(read.unknown_quality, expected.unknown_quality) << request.tag;
}

void Foreign::SetUp() {
  if (!test_server()) GTEST_SKIP() << kNoServer;
  if (!has_mariadb()) GTEST_SKIP() << kNoMariaDb;
  database.emplace();
  mariadb.emplace();
  database->execute(mariadb->server_sql());
}

void Foreign::make_history() {
  database->execute(kHistory);
  mariadb->execute(
      "CREATE TABLE native (tag varchar(80) CHARACTER SET utf8mb4 COLLATE utf8mb4_bin NOT NULL,"
      " time datetime(6) NOT NULL, value double, quality int, KEY (tag, time));" +
      as_insert(*database, "native"));
  make_foreign("elsewhere", "native");
}

void Foreign::make_foreign(const std::string& name, const std::string& remote,
                           const std::string& options) const {
  database->execute("CREATE FOREIGN TABLE " + name +
                    " (tag text, time timestamp, value float8, quality int)"
                    " SERVER mariadb OPTIONS (dbname 'plant', table_name '" +
                    remote + "'" + options + ")");
}

storage::ConnectionSettings Foreign::connection() const {
  storage::ConnectionSettings settings;
  settings.conninfo = database->conninfo();
  settings.purpose = "historian";
  return settings;
}

storage::SourceLayout Foreign::layout_of(const std::string& table, storage::TimeKind kind) {
  storage::SourceLayout layout;
  layout.relation = "public." + table;
  layout.time_kind = kind;
  if (kind == storage::TimeKind::timestamp_local) layout.time_zone = "Europe/Berlin";
  return layout;
}

}  // namespace loopscope::tests
