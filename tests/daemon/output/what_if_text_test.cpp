#include "daemon/output/what_if_text.hpp"

#include <gmock/gmock.h>

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

storage::WhatIfRow row(const char* change, std::int64_t rank, const char* loop,
                       std::optional<double> p) {
  storage::WhatIfRow row;
  row.change = change;
  row.flagged.rank = rank;
  row.flagged.loop_name = loop;
  row.flagged.code = "valve_stiction";
  row.flagged.confidence = 0.875;
  row.flagged.p = p;
  row.flagged.score = 0.5;
  row.flagged.status = "watch";
  return row;
}

TEST(WhatIfText, SaysWhatComesAndWhatGoes) {
  const std::string text =
      what_if_text({row("kept", 1, "FIC101", std::nullopt), row("gained", 2, "FIC102", 0.04),
                    row("lost", 3, "FIC103", 0.2)});
  EXPECT_EQ(text,
            "2 loops would be flagged instead of 2: 1 more, 1 no more\n"
            "   rank loop                     verdict                confidence         p   score  "
            "status\n"
            "      1 FIC101                   valve_stiction               0.88      fact   0.500  "
            "watch\n"
            "+     2 FIC102                   valve_stiction               0.88      0.04   0.500  "
            "watch\n"
            "-     - FIC103                   valve_stiction               0.88       0.2   0.500  "
            "watch\n");
}

TEST(WhatIfText, OneLoopIsNoPlural) {
  const std::string text = what_if_text({row("kept", 1, "FIC101", 0.1)});
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "1 loop would be flagged instead of 1: 0 more, 0 no more");
}

TEST(WhatIfText, NothingIsASentence) {
  EXPECT_EQ(what_if_text({}), "0 loops would be flagged instead of 0: 0 more, 0 no more\n");
}

TEST(WhatIfText, NamesSteerNoTerminal) {
  EXPECT_THAT(what_if_text({row("kept", 1, "a\x1b[2J\nb", 0.1)}), HasSubstr("a\\x1b[2J\\x0ab"));
}

}  // namespace
}  // namespace loopscope::daemon
