#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {

std::int64_t second(std::int64_t seconds) {
  return (1'767'225'600 + seconds) * 1'000'000;
}

TagRequest request(const std::string& tag, std::int64_t from_s, std::int64_t to_s,
                   std::int64_t max_rows) {
  return {tag, second(from_s), second(to_s), max_rows, RowBefore::no};
}

TagRows rows_of(const std::string& tag, const std::vector<double>& values) {
  TagRows rows{tag, {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    rows.rows.time_us.push_back(second(static_cast<std::int64_t>(i)));
    rows.rows.value.push_back(values[i]);
  }
  return rows;
}

core::signal::RawSeries read_one(HistorianReader& reader, const TagRequest& wanted) {
  return reader.read(std::vector{wanted}).at(0);
}

void HistorianTest::SetUp() {
  if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
  database = std::make_unique<tests::TestDatabase>();
  ASSERT_TRUE(create_historian_table(settings(), layout));
}

ConnectionSettings HistorianTest::settings(const std::string& user) const {
  ConnectionSettings settings;
  settings.conninfo = user.empty() ? database->conninfo() : database->conninfo(user);
  settings.purpose = "historian";
  return settings;
}

void HistorianTest::insert(const std::string& tag, const std::string& time,
                           const std::string& value, const std::string& quality) {
  database->execute("INSERT INTO public.history VALUES ('" + tag + "', '" + time + "', " + value +
                    ", " + quality + ")");
}

}  // namespace loopscope::storage
