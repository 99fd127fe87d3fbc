// Array literals, the way in which every batch of rows travels: whatever is put in comes out, read
// by a reader of PostgreSQL's array syntax that knows nothing of the writer.

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>

#include "daemon/text/cell_failure.hpp"
#include "storage/array_literal.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"
#include "tests/fuzz/array_reader.hpp"
#include "tests/fuzz/odd_number.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace loopscope::tests::fuzz {
namespace {

using Element = std::optional<std::string>;

constexpr std::size_t kLongestText = 40;

Element add_number(storage::ArrayLiteral& array, double value) {
  array.add_number(value);
  if (!std::isfinite(value)) return std::nullopt;
  const std::string text = storage::number_text(value);
  const double again = std::strtod(text.c_str(), nullptr);
  require(std::memcmp(&again, &value, sizeof value) == 0, "a number comes back to the last bit");
  return text;
}

Element add_text(storage::ArrayLiteral& array, const std::string& text) {
  array.add_text(text);
  const std::string stored = storage::make_storable(text);
  require(storage::is_storable(stored), "what is written can be stored");
  require(stored == storage::make_storable(stored), "mending twice is mending once");
  require(!storage::is_storable(text) || stored == text, "valid text stays as it is");
  return stored;
}

Element add_list(storage::ArrayLiteral& array, ByteSource& source) {
  std::vector<std::string> texts(source.byte() % 4);
  for (std::string& text : texts) text = source.text(kLongestText);
  array.add_text_list(texts);
  storage::ArrayLiteral inner;
  std::vector<Element> expected;
  for (const std::string& text : texts) expected.push_back(add_text(inner, text));
  require(read_array(inner.text()) == expected, "a list in a list comes back");
  return inner.text();
}

Element add_time(storage::ArrayLiteral& array, std::int64_t time_us) {
  array.add_time(time_us);
  return storage::timestamp_text(time_us);
}

Element add_element(storage::ArrayLiteral& array, ByteSource& source) {
  switch (source.byte() % 7) {
    case 0: {
      const bool value = source.truth();
      array.add_boolean(value);
      return value ? "t" : "f";
    }
    case 1: {
      const auto value = source.number<std::int64_t>();
      array.add_integer(value);
      return std::to_string(value);
    }
    case 2:
      return add_number(array, odd_number(source));
    case 3:
      return add_time(array, source.number<std::int64_t>());
    case 4:
      return add_list(array, source);
    case 5:
      array.add_null();
      return std::nullopt;
    default:
      return add_text(array, source.text(kLongestText));
  }
}

/// Cells in messages: one line of printable text, whatever they hold.
void check_shown(const std::string& text) {
  const std::string shown = daemon::shown(text);
  require(shown.size() < 400, "a message stays short");
  require(shown.find_first_of("\n\r\t\x1b") == std::string::npos, "no line break, no escape");
  require(shown.find('\0') == std::string::npos, "no zero byte");
}

}  // namespace

int fuzz_array_literal(const std::uint8_t* data, std::size_t size) {
  check_shown({reinterpret_cast<const char*>(data), size});
  ByteSource source(data, size);
  storage::ArrayLiteral array;
  std::vector<Element> expected;
  while (!source.empty()) expected.push_back(add_element(array, source));
  require(read_array(array.text()) == expected, "what is put in comes out");
  return 0;
}

}  // namespace loopscope::tests::fuzz
