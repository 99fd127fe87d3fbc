#pragma once

#include "storage/historian/scan_rows.hpp"
#include "tests/fuzz/byte_source.hpp"
#include "tests/fuzz/wire.hpp"

namespace loopscope::tests::fuzz {

/// What a historian was asked and what came back.
struct HistorianAnswer {
  storage::ResolvedLayout layout;
  storage::Scan scan;
  storage::PqRows rows;
  /// The answer keeps what the statement asks for: times inside the span, newest first, the row
  /// before earlier than all of them, as many values as times. Otherwise cells hold anything.
  bool sane = true;
};

/// Makes a question and an answer out of bytes.
[[nodiscard]] HistorianAnswer make_answer(ByteSource& source);

}  // namespace loopscope::tests::fuzz
