#include "daemon/report/sections/repairs_table.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kRepairUs = 1'772'366'400'000'000;  // 2026-03-01T12:00:00Z

storage::RepairFigure figure(const char* name, const char* unit, double before, double after) {
  storage::RepairFigure figure;
  figure.name = name;
  figure.unit = unit;
  figure.before = before;
  figure.after = after;
  return figure;
}

storage::RepairRow repair() {
  storage::RepairRow row;
  row.loop_name = "FIC1";
  row.done_at_us = kRepairUs;
  row.kind = "valve";
  row.description = "new packing";
  row.word = "improved";
  row.statement = "Improved: the error is smaller.";
  row.figures = {figure("error_std", "pv units", 2.0, 1.0), figure("nli", "", 0.3, 0.1),
                 figure("valve_deadband.width", "%", 4.0, 0.0)};
  storage::RepairFigure& ratio = row.figures[0];
  ratio.is_ratio = true;
  ratio.change = 0.5;
  ratio.change_low = 0.44;
  ratio.change_high = 0.57;
  storage::RepairFigure& difference = row.figures[1];
  difference.change = -0.2;
  difference.change_low = -0.25;
  difference.change_high = -0.15;
  row.figures[2].after.reset();
  return row;
}

/// The row without the head of the table and the note below it.
std::string row_of(const storage::RepairRow& row) {
  const std::string html = repairs_table({row}, {}).html;
  const std::size_t begin = html.find("<tbody>\n") + 8;
  return html.substr(begin, html.find("\n</tbody>") - begin);
}

TEST(RepairsTable, ARowSaysWhatWasDoneWhatCameOfItAndByHowMuch) {
  EXPECT_EQ(row_of(repair()),
            "<tr><td data-label=\"Loop\"><bdi>FIC1</bdi></td><td class=\"when\" "
            "data-label=\"Done\" data-sort=\"1772366400000000\">2026-03-01 12:00 UTC</td>"
            "<td data-label=\"Work\">valve: <bdi>new packing</bdi></td><td data-label=\"Result\">"
            "<span class=\"word improved\">improved</span></td><td data-label=\"Why\">Improved: "
            "the error is smaller. <small><span class=\"pair\">error std 2 \u2192 1 units of pv "
            "(\u00d7 0.5, 0.44 to 0.57)</span> <span class=\"pair\">nli 0.3 \u2192 0.1 (by -0.2, "
            "-0.25 to -0.15)</span> <span class=\"pair\">valve deadband width 4 \u2192 \u2013 %"
            "</span></small></td></tr>");
}

TEST(RepairsTable, OfOneLoopInItsUnit) {
  EXPECT_NE(repairs_table({repair()}, {}, "m3/h").html.find("error std 2 \u2192 1 m3/h (\u00d7"),
            std::string::npos);
}

TEST(RepairsTable, WhoEnteredItIsNamed) {
  storage::RepairRow entered = repair();
  entered.author = "ls_engineer";
  entered.on_behalf_of = "J. Doe";
  EXPECT_NE(row_of(entered).find("<bdi>new packing</bdi> <small>entered by <bdi>J. Doe (login "
                                 "ls_engineer)</bdi></small></td>"),
            std::string::npos)
      << row_of(entered);
}

TEST(RepairsTable, WithoutRepairsThereIsNone) {
  EXPECT_EQ(repairs_table({}, {}).html, "");
}

}  // namespace
}  // namespace loopscope::daemon
