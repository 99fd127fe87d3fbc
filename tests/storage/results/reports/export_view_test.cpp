#include "storage/results/reports/export_view.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

const ExportedView* view_named(const std::string& name) {
  const auto found = std::ranges::find_if(
      exported_views(), [&](const ExportedView& view) { return name == view.name; });
  return &*found;
}

class ExportViewTest : public ViewsTest {
 protected:
  struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<ExportedValue>> rows;
    [[nodiscard]] ExportedValue at(std::size_t row, const std::string& column) const {
      const auto found = std::ranges::find(header, column);
      return rows.at(row).at(static_cast<std::size_t>(found - header.begin()));
    }
  };
  [[nodiscard]] Table rows_of(const ExportRequest& request) const {
    Table table;
    export_rows(
        settings_for(*database), request,
        [&](const std::vector<std::string>& names) { table.header = names; },
        [&](const std::vector<ExportedValue>& row) { table.rows.push_back(row); });
    return table;
  }
  [[nodiscard]] std::vector<nlohmann::json> objects_of(const ExportRequest& request) const {
    std::vector<nlohmann::json> objects;
    export_objects(settings_for(*database), request, [&](const std::string& object) {
      objects.push_back(nlohmann::json::parse(object));
    });
    return objects;
  }
};

TEST_F(ExportViewTest, EveryViewOfTheListIsThereWithTheColumnsThatItsRowNames) {
  EXPECT_FALSE(exported_views().empty());
  for (const ExportedView& view : exported_views()) {
    SCOPED_TRACE(view.name);
    const Table table = rows_of({&view, "", std::nullopt});
    EXPECT_EQ(view.has_loop, std::ranges::count(table.header, "loop_name") == 1);
    if (*view.time_column != '\0') {
      EXPECT_EQ(value(std::string("SELECT data_type FROM information_schema.columns WHERE"
                                  " table_schema = 'loopscope' AND table_name = '") +
                      view.name + "' AND column_name = '" + view.time_column + "'"),
                "timestamp with time zone");
      EXPECT_NO_THROW(static_cast<void>(objects_of({&view, view.has_loop ? "a" : "", slot(1)})));
    }
  }
}

/// A view for people that is not in the list was forgotten.
TEST_F(ExportViewTest, EveryViewForPeopleIsInTheList) {
  // What others are made of.
  std::vector<std::string> names{"hiding",      "newest_plant_round", "fault_family",
                                 "figure_kind", "maintenance_job",    "maintenance_window"};
  for (const ExportedView& view : exported_views()) names.emplace_back(view.name);
  std::ranges::sort(names);
  EXPECT_EQ(column("SELECT relname FROM pg_class WHERE relkind = 'v' AND relnamespace ="
                   " 'loopscope'::regnamespace ORDER BY relname COLLATE \"C\""),
            names);
}

TEST_F(ExportViewTest, ValuesAsScriptsReadThem) {
  tell({{.loop = "a,\"b\"", .harris = 0.2}});
  database->execute("UPDATE loopscope.analysis SET window_start = '2026-01-01 00:00:00.5+00'");
  const ExportRequest request{view_named("latest_verdict"), "", std::nullopt};
  const Table table = rows_of(request);
  ASSERT_THAT(table.rows, SizeIs(1));
  EXPECT_EQ(table.at(0, "loop_name"), "a,\"b\"");
  EXPECT_EQ(table.at(0, "slot_end"), "2026-01-01T01:00:00Z");
  EXPECT_EQ(table.at(0, "window_start"), "2026-01-01T00:00:00.5Z");
  EXPECT_EQ(table.at(0, "enabled"), "true");
  EXPECT_EQ(table.at(0, "oscillation_p"), std::nullopt);
  EXPECT_EQ(table.at(0, "harris_low"), "0.2");
  EXPECT_EQ(table.at(0, "reasons"), "first, with a comma; second 'quoted' \"reason\"");
  const nlohmann::json object = objects_of(request).at(0);
  EXPECT_EQ(object["loop_name"], "a,\"b\"");
  EXPECT_EQ(object["enabled"], true);
  EXPECT_EQ(object["oscillation_p"], nullptr);
  EXPECT_EQ(object["reasons"][1], "second 'quoted' \"reason\"");
  EXPECT_TRUE(object["slot_end"].get<std::string>().starts_with("2026-01-01T01:00:00"));
}

TEST_F(ExportViewTest, OneLoopAndSinceATime) {
  tell({{.loop = "a", .slot_hours = 1}, {.loop = "a", .slot_hours = 2}, {.loop = "b"}});
  const ExportedView* view = view_named("loop_history");
  EXPECT_THAT(rows_of({view, "", std::nullopt}).rows, SizeIs(3));
  EXPECT_THAT(rows_of({view, "a", std::nullopt}).rows, SizeIs(2));
  EXPECT_THAT(rows_of({view, "", slot(2)}).rows, SizeIs(1));
  EXPECT_THAT(objects_of({view, "a", slot(2)}), SizeIs(1));
  EXPECT_THAT(objects_of({view, "x'; DROP TABLE loopscope.loop", std::nullopt}), IsEmpty());
}

TEST_F(ExportViewTest, AnEmptyViewHasAHeaderAndManyRowsComeInOrder) {
  EXPECT_THAT(rows_of({view_named("flagged_loop"), "", std::nullopt}).header,
              testing::Contains("loop_name"));
  database->execute(
      "INSERT INTO loopscope.loop (name, source, pv_tag, period_s)"
      " SELECT k::text, 'main', 'PV', 3600 FROM generate_series(1, 2500) AS k");
  EXPECT_THAT(objects_of({view_named("monitor_health"), "", std::nullopt}), SizeIs(2500));
  database->execute(
      "DELETE FROM loopscope.loop WHERE loop_id > (SELECT min(loop_id) + 999"
      " FROM loopscope.loop)");
  EXPECT_THAT(rows_of({view_named("monitor_health"), "", std::nullopt}).rows, SizeIs(1000));
}

}  // namespace
}  // namespace loopscope::storage
