#include "tests/architecture/include_rules.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <utility>

#include "tests/architecture/rooms.hpp"

namespace loopscope::tests::architecture {
namespace {

using testing::HasSubstr;

/// What the checker says about one include line in one file; empty when it is allowed.
std::string verdict(const std::string& path, const std::string& header) {
  return listing(check_includes({path, "#pragma once\n#include " + header + "\n"}));
}

TEST(IncludeRules, HoldInTheWholeCheckout) {
  std::vector<Violation> all;
  for (const SourceFile& file : source_files()) {
    const std::vector<Violation> found = check_includes(file);
    all.insert(all.end(), found.begin(), found.end());
  }
  EXPECT_TRUE(all.empty()) << listing(all);
}

TEST(IncludeRules, EveryExceptionIsStillNeeded) {
  const std::vector<SourceFile> files = source_files();
  for (const Exception& exception : exceptions()) {
    const auto file = std::find_if(files.begin(), files.end(), [&](const SourceFile& candidate) {
      return candidate.path == exception.file;
    });
    ASSERT_NE(file, files.end()) << exception.file;
    const std::string header(exception.header);
    EXPECT_THAT(file->text, testing::AnyOf(HasSubstr("#include <" + header + ">"),
                                           HasSubstr("#include \"" + header + "\"")))
        << exception.file;
  }
}

TEST(IncludeRules, BadIncludeIsNamedWithFileAndLine) {
  EXPECT_EQ(verdict("core/hos/bicoherence/peaks.cpp", "\"storage/error.hpp\""),
            "core/hos/bicoherence/peaks.cpp:2: core/hos may not use storage (storage/error.hpp)\n");
}

TEST(IncludeRules, EveryViolationOfAFileIsListed) {
  const SourceFile file{"core/loop/shape.cpp",
                        "#include <vector>\n# include <thread>\n  #include \"shape.hpp\"\n"};
  EXPECT_EQ(check_includes(file).size(), 2U);
}

TEST(IncludeRules, ArrowsPointDown) {
  EXPECT_EQ(verdict("core/diagnosis/decide.cpp", "\"core/loop/shape.hpp\""), "");
  EXPECT_EQ(verdict("core/loop/shape.cpp", "\"core/signal/raw_series.hpp\""), "");
  EXPECT_EQ(verdict("daemon/lab/simulate/record_csv.cpp", "\"core/simulate/loop.hpp\""), "");
  EXPECT_EQ(verdict("daemon/lab/simulate/record_csv.cpp", "\"daemon/text/failure.hpp\""), "");
  EXPECT_EQ(verdict("storage/check.cpp", "\"core/diagnosis/diagnose.hpp\""), "");
  for (const auto& [file, header] :
       {std::pair{"core/signal/grid.cpp", "\"core/hos/analyse.hpp\""},
        std::pair{"core/signal/grid.cpp", "\"core/diagnosis/verdicts/verdict.hpp\""},
        std::pair{"core/loop/shape.cpp", "\"core/simulate/loop.hpp\""},
        std::pair{"config/settings.hpp", "\"storage/error.hpp\""},
        std::pair{"config/settings.hpp", "\"core/simulate/loop.hpp\""},
        std::pair{"storage/check.cpp", "\"config/settings.hpp\""},
        std::pair{"daemon/report/report.cpp", "\"core/simulate/loop.hpp\""},
        std::pair{"daemon/report/report.cpp", "\"daemon/lab/simulate/record_csv.hpp\""},
        std::pair{"storage/check.cpp", "\"daemon/text/failure.hpp\""}})
    EXPECT_THAT(verdict(file, header), HasSubstr(" may not use ")) << file << " " << header;
}

TEST(IncludeRules, IncludesOfTheProjectAreRooted) {
  for (const char* header : {"\"peaks.hpp\"", "\"../signal/grid.hpp\"", "\"tests/x.hpp\"",
                             "\"corex/y.hpp\"", "\"nlohmann/json.hpp\""})
    EXPECT_THAT(verdict("daemon/main.cpp", header), HasSubstr("does not start at the root"));
}

TEST(IncludeRules, LibrariesStayInTheirRooms) {
  EXPECT_EQ(verdict("core/hos/transforms/spectra.cpp", "<fftw3.h>"), "");
  EXPECT_EQ(verdict("core/hos/literature/hinich.cpp", "<boost/math/distributions/chi_squared.hpp>"),
            "");
  EXPECT_EQ(verdict("core/loop/shape.cpp", "<unsupported/Eigen/FFT>"), "");
  EXPECT_EQ(verdict("config/document.cpp", "<nlohmann/json.hpp>"), "");
  EXPECT_EQ(verdict("storage/check.cpp", "<pqxx/pqxx>"), "");
  EXPECT_EQ(verdict("daemon/commands/program.cpp", "<asio/post.hpp>"), "");
  for (const auto& [file, header] :
       {std::pair{"core/loop/shape.cpp", "<fftw3.h>"},
        std::pair{"core/signal/grid.cpp", "<Eigen/Core>"},
        std::pair{"core/hos/bicoherence/peaks.cpp", "<nlohmann/json.hpp>"},
        std::pair{"config/document.cpp", "<fmt/format.h>"},
        std::pair{"storage/check.cpp", "<nlohmann/json.hpp>"},
        std::pair{"daemon/commands/program.cpp", "<pqxx/pqxx>"},
        std::pair{"daemon/commands/program.cpp", "<libpq-fe.h>"},
        std::pair{"daemon/commands/program.cpp", "<gtest/gtest.h>"}})
    EXPECT_THAT(verdict(file, header), HasSubstr(" may not use ")) << file << " " << header;
  EXPECT_THAT(verdict("daemon/commands/program.cpp", "<boost/asio.hpp>"), HasSubstr("no library"));
}

TEST(IncludeRules, CoreOnlyComputes) {
  for (const char* header :
       {"<iostream>", "<fstream>", "<cstdio>", "<filesystem>", "<chrono>", "<ctime>", "<thread>",
        "<mutex>", "<atomic>", "<cstdlib>", "<unistd.h>", "<sys/stat.h>", "<stdio.h>"})
    EXPECT_THAT(verdict("core/signal/grid.cpp", header), HasSubstr("may not use")) << header;
  for (const char* header : {"<vector>", "<cmath>", "<random>", "<numbers>"})
    EXPECT_EQ(verdict("core/signal/grid.cpp", header), "");
  EXPECT_EQ(verdict("daemon/service/analysis_worker.cpp", "<thread>"), "");
  EXPECT_EQ(verdict("storage/check.cpp", "<unistd.h>"), "");
}

TEST(IncludeRules, CoreHasNoHiddenRandomness) {
  const std::string use = "  std::random_device seed;\n";
  EXPECT_THAT(listing(check_includes({"core/simulate/loop.cpp", use})),
              HasSubstr("core/simulate/loop.cpp:1: core/simulate may not use random_device"));
  EXPECT_TRUE(
      check_includes({"core/simulate/loop.cpp", "// no std::random_device here\n"}).empty());
  EXPECT_TRUE(check_includes({"daemon/service/analysis_worker.cpp", use}).empty());
}

TEST(IncludeRules, MutexIsForTheFftwPlannerAlone) {
  EXPECT_EQ(verdict("core/hos/kernels/plan_cache.hpp", "<mutex>"), "");
  EXPECT_THAT(verdict("core/hos/transforms/spectra.cpp", "<mutex>"), HasSubstr("may not use"));
}

}  // namespace
}  // namespace loopscope::tests::architecture
