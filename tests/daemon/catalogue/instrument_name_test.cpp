#include "daemon/catalogue/instrument_name.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

char kind_of_letters(const char* letters) {
  const auto found = instrument_letters(letters);
  if (!found) return '-';
  switch (found->kind) {
    case InstrumentKind::controller:
      return 'c';
    case InstrumentKind::transmitter:
      return 't';
    case InstrumentKind::indicator:
      return 'i';
    case InstrumentKind::other:
      return 'o';
  }
  return '?';
}

TEST(InstrumentName, LettersAfterIsa) {
  for (const char* letters : {"FC", "FIC", "TRC", "PDIC", "ffic", "LICA", "TICAHL", "FQIC", "LIRC"})
    EXPECT_EQ(kind_of_letters(letters), 'c') << letters;
  for (const char* letters : {"FT", "PDT", "FIT", "te", "LIT", "PDIT"})
    EXPECT_EQ(kind_of_letters(letters), 't') << letters;
  for (const char* letters : {"FI", "TIR", "FQI", "FQ", "TAH", "LSLL", "TSHH", "LI"})
    EXPECT_EQ(kind_of_letters(letters), 'i') << letters;
  for (const char* letters : {"FV", "FCV", "XV", "FY", "TZI"})
    EXPECT_EQ(kind_of_letters(letters), 'o') << letters;
  for (const char* letters :
       {"", "F", "TANK", "AREA", "UNIT", "PUMP", "PLC", "MCC", "LINE", "SEAL", "PACIFIC"})
    EXPECT_EQ(kind_of_letters(letters), '-') << letters;
}

TEST(InstrumentName, ItsParts) {
  const auto name = instrument_name("Area1/21FIC-005A");
  ASSERT_TRUE(name);
  EXPECT_EQ(name->place, "area1/21");
  EXPECT_EQ(name->letters.measured, "F");
  EXPECT_EQ(name->number, "005");
  EXPECT_EQ(name->suffix, "a");
  EXPECT_TRUE(name->ends_path);
  EXPECT_FALSE(instrument_name("FIC-005A/PID1")->ends_path);
  EXPECT_EQ(instrument_name("330A0013FIC")->place, "330a0013");
  EXPECT_EQ(instrument_name("PDT_7")->letters.measured, "PD");
  EXPECT_EQ(instrument_name("TI1/FIC2")->number, "2") << "the last one";
  for (const char* other : {"", "FIC", "TANK-1", "101", "FIC.101"})
    EXPECT_FALSE(instrument_name(other)) << other;
}

}  // namespace
}  // namespace loopscope::daemon
