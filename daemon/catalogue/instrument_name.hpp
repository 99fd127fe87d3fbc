#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// What an instrument does by the letters of its name, ISA 5.1.
enum class InstrumentKind {
  controller,   ///< FIC, TRC, PDIC, LICA
  transmitter,  ///< FT, PDT, FIT; also elements: TE
  indicator,    ///< FI, TIR, FQI, and alarms and switches: TAH, LSLL
  other         ///< valves, relays, positions: FV, FCV, FY, ZT's letter Z behind the first
};

struct InstrumentLetters {
  std::string measured;  ///< upper case: "F", "PD" (difference), "FF" (ratio)
  InstrumentKind kind;
};

/// Letters of an instrument, whatever their case; nullopt when they are none, as of "TANK".
[[nodiscard]] std::optional<InstrumentLetters> instrument_letters(std::string_view letters);

/// "Area1/21FIC-005A" taken apart.
struct InstrumentName {
  std::string place;  ///< what stands before the letters, lower case: "area1/21"
  InstrumentLetters letters;
  std::string number;  ///< "005"; empty = it stands before the letters (330A0013FIC)
  std::string suffix;  ///< letters behind the number, lower case: "a"
  bool ends_path;      ///< nothing follows in the path
};

/// The last instrument's name in a path; nullopt when there is none. Letters count where a number
/// stands beside them, perhaps behind a `-`, `_` or blank.
[[nodiscard]] std::optional<InstrumentName> instrument_name(std::string_view path);

}  // namespace loopscope::daemon
