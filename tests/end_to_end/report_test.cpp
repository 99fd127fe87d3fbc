#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/hostile_names.hpp"
#include "tests/support/process.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two faults and a healthy loop, analysed.
void make_faulty_plant(const Plant& plant) {
  plant.import_simulated("FIC101", "sticking_valve", "102");
  plant.import_simulated("<b>\"TIC\" & co</b>", "tight_tuning", "104");
  plant.import_simulated("FIC103", "healthy_flow", "103");
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(Report, OneFileTellsOfEveryFlaggedLoopWithItsPictures) {
  const Plant plant;
  make_faulty_plant(plant);
  const std::string folder = plant.folder() / "reports";
  const ProgramResult result = plant.loopscope("report", {"--out", folder});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 flagged loops"));
  const std::string page = content_of(folder + "/report.html");
  EXPECT_EQ(count(page, "<section class=\"loop\""), 2U);
  EXPECT_GE(count(page, "<img src=\"data:image/svg+xml,"), 12U);
  EXPECT_THAT(page, HasSubstr("Valve stiction"));
  EXPECT_THAT(page, HasSubstr("<th>Test that spoke</th>"));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&quot;TIC&quot; &amp; co&lt;/b&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<b>\"TIC\"")));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy"));
  EXPECT_EQ(count(page, "http://"), count(page, "='http://www.w3.org/")) << "names of SVG only";
  EXPECT_THAT(page, Not(HasSubstr("https://")));
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(page, HasSubstr("All times are UTC."));
  EXPECT_THAT(page, HasSubstr("<th>Since (UTC)</th>"));

  plant.write_settings(Plant::settings(R"("plant": {"time_zone": "Asia/Kolkata"})"));
  const std::vector<std::string> since{"--out", folder, "--no-pictures", "--since"};
  const auto report_since = [&](const char* time) {
    std::vector<std::string> arguments = since;
    arguments.emplace_back(time);
    return plant.loopscope("report", arguments);
  };
  ASSERT_EQ(report_since("2026-03-01 17:30").exit_code, 0);
  const std::string local = content_of(folder + "/report.html");
  EXPECT_THAT(
      local,
      HasSubstr("<p><span>Loopscope report,</span> <span>2026-03-01 17:30 IST to</span> <span>"));
  EXPECT_THAT(local, HasSubstr("<th>Since (Asia/Kolkata)</th>"));
  EXPECT_THAT(local, HasSubstr("All times are local, Asia/Kolkata."));
  EXPECT_THAT(local, Not(HasSubstr(" UTC")));
  plant.write_settings(Plant::settings(R"("plant": {"time_zone": "Europe/Berlin"})"));
  const ProgramResult twice = report_since("2026-10-25 02:30");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("--since \"2026-10-25 02:30\" is two times in Europe/Berlin"));
  EXPECT_THAT(twice.err, HasSubstr("HINT: write the offset: 2026-10-25T02:30:00+02:00 (CEST) or"));
}

TEST(Report, WithoutTheHistorianTheStoredFiguresStand) {
  const Plant plant;
  make_faulty_plant(plant);
  plant.sql("drop table history");
  const std::string folder = plant.folder() / "reports";
  const ProgramResult result = plant.loopscope("report", {"--out", folder});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = content_of(folder + "/report.html");
  EXPECT_EQ(count(page, "<section class=\"loop\""), 2U);
  EXPECT_THAT(page, HasSubstr("No pictures of the window: the window could not be read again"));
  EXPECT_THAT(page, HasSubstr("Valve stiction"));
  EXPECT_THAT(result.err, HasSubstr("note: 2 of them without pictures"));
}

TEST(Report, NothingIsWrittenWhenTheResultsAreAway) {
  const Plant plant;
  plant.write_settings(R"({"results": {"connection": "host=/nowhere"},
                           "historians": [{"connection": "host=/nowhere"}]})");
  const std::string folder = plant.folder() / "reports";
  const ProgramResult result = plant.loopscope("report", {"--out", folder});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, HasSubstr("HINT: "));
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(Report, SaysWhichPackageIsMissing) {
  const Plant plant;
  make_faulty_plant(plant);
  const std::string folder = plant.folder() / "reports";
  std::vector<std::string> command{"/usr/bin/env", "PATH=/nonexistent"};
  for (const std::string& argument : plant.command_line("report")) command.push_back(argument);
  command.insert(command.end(), {"--out", folder});
  const ProgramResult without_gnuplot = run_program(command);
  EXPECT_EQ(without_gnuplot.exit_code, 3);
  EXPECT_THAT(without_gnuplot.err, HasSubstr("apt-get install gnuplot-nox"));
  EXPECT_FALSE(std::filesystem::exists(folder));
  command.emplace_back("--no-pictures");
  EXPECT_EQ(run_program(command).exit_code, 0);
  command.emplace_back("--pdf");
  const ProgramResult without_engine = run_program(command);
  EXPECT_EQ(without_engine.exit_code, 3);
  EXPECT_THAT(without_engine.err, HasSubstr("apt-get install weasyprint"));
}

// Whoever ends the program by its number alone must not leave the PDF's engine at work.
TEST(Report, TheEngineEndsWithTheProgram) {
  const Plant plant;
  const std::string pid_file = plant.folder() / "pid";
  const std::filesystem::path engine = plant.folder() / "weasyprint";
  std::ofstream(engine) << "#!/bin/sh\necho $$ > " << pid_file << ".new\nmv " << pid_file << ".new "
                        << pid_file << "\nexec sleep 600\n";
  std::filesystem::permissions(engine, std::filesystem::perms::owner_all);
  std::vector<std::string> command{"/usr/bin/env", "PATH=" + plant.folder().string()};
  for (const std::string& argument : plant.command_line("report")) command.push_back(argument);
  const std::string folder = plant.folder() / "reports";
  command.insert(command.end(), {"--out", folder, "--pdf", "--no-pictures"});
  BackgroundProgram program(command, plant.folder() / "log");
  const std::string child = first_line_of(pid_file, 60.0);
  EXPECT_NE(child, "") << content_of(plant.folder() / "log");
  program.send(SIGTERM);
  EXPECT_EQ(program.wait(20.0), -1) << "a signal is no exit";
  EXPECT_TRUE(ends_within(child, 20.0));
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(Report, ThePdfHasTheSameLoops) {
  if (!std::filesystem::exists("/usr/bin/weasyprint")) GTEST_SKIP() << "no weasyprint";
  const Plant plant;
  make_faulty_plant(plant);
  const std::string folder = plant.folder() / "reports";
  const ProgramResult result = plant.loopscope("report", {"--out", folder, "--pdf"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(content_of(folder + "/report.pdf").starts_with("%PDF"));
  if (!std::filesystem::exists("/usr/bin/pdftotext")) {
    GTEST_SKIP() << "no pdftotext (package poppler-utils): the words of the PDF were not read";
  }
  const std::string text = run_program({"/usr/bin/pdftotext", folder + "/report.pdf", "-"}).out;
  EXPECT_THAT(text, HasSubstr("FIC101"));
  EXPECT_THAT(text, HasSubstr("<b>\"TIC\" & co</b>"));
}

// The daemon takes a page that is there for a whole report: one without its PDF would stay so.
TEST(Report, ThePageComesWithItsPdfOrNotAtAll) {
  if (!std::filesystem::exists("/usr/bin/weasyprint")) GTEST_SKIP() << "no weasyprint";
  const Plant plant;
  make_faulty_plant(plant);
  const std::string folder = plant.folder() / "reports";
  std::filesystem::create_directories(folder + "/report.pdf");  // in its way
  const std::vector<std::string> arguments{"--out", folder, "--pdf", "--no-pictures"};
  const ProgramResult refused = plant.loopscope("report", arguments);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("report.pdf"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/report.html"));
  std::filesystem::remove(folder + "/report.pdf");
  EXPECT_EQ(plant.loopscope("report", arguments).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder + "/report.html"));
}

TEST(Report, TheDaemonWritesOneEverySoOftenAndKeepsAFew) {
  const Plant plant;
  make_faulty_plant(plant);
  const std::filesystem::path folder = plant.folder() / "reports";
  std::filesystem::create_directories(folder);
  std::filesystem::path old = folder / "loopscope-2020-01-01T0000Z.html";
  for (const char* name :
       {"loopscope-2020-01-01T0000Z.html", "loopscope-2020-01-02T0000Z.html", "notes.html"})
    std::ofstream(folder / name) << "";
  plant.write_settings(Plant::settings(R"("schedule": {"poll_s": 0.2},
      "daemon": {"http_address": ""},
      "report": {"folder": ")" + folder.string() +
                                       R"(", "keep": 2})"));
  BackgroundProgram first(plant.command_line("run"), plant.folder() / "first.log");
  BackgroundProgram second(plant.command_line("run"), plant.folder() / "second.log");
  for (int k = 0; k < 300 && std::filesystem::exists(old); ++k) usleep(100'000);
  first.send(SIGTERM);
  second.send(SIGTERM);
  EXPECT_EQ(first.wait(30), 0);
  EXPECT_EQ(second.wait(30), 0);
  EXPECT_FALSE(std::filesystem::exists(old));
  EXPECT_TRUE(std::filesystem::exists(folder / "notes.html"));
  const std::string logs =
      content_of(plant.folder() / "first.log") + content_of(plant.folder() / "second.log");
  EXPECT_EQ(count(logs, "report written: "), 1U) << logs;
}

}  // namespace
}  // namespace loopscope::tests
