#include <algorithm>
#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>

#include "daemon/monitor/metrics.hpp"
#include "tests/daemon/monitor/exposition.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

const BuildInfo kBuild{"0.1.0", 8, "avx2"};
constexpr const char* kStart = "loopscope_start_time_seconds";

double now_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

TEST(MetricsOfTheProcess, SayWhichProgramItIs) {
  const std::string text = Metrics(kBuild).text();
  const auto all = read_exposition(text).samples;
  EXPECT_EQ(std::ranges::count_if(all,
                                  [](const auto& sample) {
                                    return sample.first.starts_with("loopscope_build_info{") &&
                                           sample.second == 1.0;
                                  }),
            1);
  for (const char* label : {R"(version="0.1.0")", R"(algorithm_revision="8")", R"(path="avx2")"}) {
    EXPECT_THAT(text, HasSubstr(label));
  }
}

/// To the millisecond: `changes()` has to see a process that was started anew at once.
TEST(MetricsOfTheProcess, SayWhenItBegan) {
  const double before = now_s();
  const Metrics metrics(kBuild);
  const double began = read_exposition(metrics.text()).samples.at(kStart);
  EXPECT_GE(began, before - 1e-3);
  EXPECT_LE(began, now_s() + 1e-3);
  EXPECT_EQ(read_exposition(metrics.text()).samples.at(kStart), began) << "it never changes";
}

TEST(OldestSnapshotTest, AgesWhileItIsTheSame) {
  using std::chrono::seconds;
  OldestSnapshot snapshot;
  const OldestSnapshot::Clock::time_point start;
  EXPECT_EQ(snapshot.seconds_kept("731", start), 0.0);
  EXPECT_EQ(snapshot.seconds_kept("731", start + seconds(60)), 60.0);
  EXPECT_EQ(snapshot.seconds_kept("732", start + seconds(90)), 0.0) << "another is a younger one";
  EXPECT_EQ(snapshot.seconds_kept("", start + seconds(120)), 0.0);
  EXPECT_EQ(snapshot.seconds_kept("", start + seconds(180)), 0.0);
  EXPECT_EQ(snapshot.seconds_kept("732", start + seconds(240)), 0.0);
}

}  // namespace
}  // namespace loopscope::daemon
