#include "tests/support/hostile_names.hpp"

#include <algorithm>
#include <iterator>

namespace loopscope::tests {
namespace {

using namespace std::string_literals;

constexpr std::size_t kLongestIdentifier = 63;

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t k = 0; k < times; ++k) text += part;
  return text;
}

}  // namespace

const std::vector<HostileName>& hostile_names() {
  static const std::vector<HostileName> names{
      {"SQL", "'; DROP TABLE loopscope.loop; --"},
      {"SQL", "\"; DROP TABLE history; --"},
      {"SQL", "x' OR '1'='1"},
      {"SQL", "'"},
      {"SQL", "\""},
      {"SQL", "''\"\""},
      {"SQL", "\\"},
      {"SQL", "\\'"},
      {"SQL", "E'\\x27'"},
      {"SQL", "U&\"\\0041\""},
      {"SQL", "/* */ -- "},
      {"SQL", "$1"},
      {"SQL", "$$; SELECT 1; $$"},
      {"SQL", ";"},
      {"SQL keyword", "select"},
      {"SQL keyword", "NULL"},
      {"SQL keyword", "user"},
      {"SQL pattern", "%_"},
      {"SQL, two names", "public.history"},
      {"array", "{}"},
      {"array", "{a,b}"},
      {"array", "a,\"b\",c"},
      {"array", "\"\"\"\\\"{}"},
      {"row", "(1,2)"},
      {"COPY", "\\N"},
      {"COPY", "\\."},
      {"COPY", "\\t\\b"},
      {"format string", "%s%n%d %%"},
      {"format string", "{0} {} {:f} {{"},
      {"CSV", ","},
      {"CSV", "\",\""},
      {"CSV", "a;b|c"},
      {"blanks", " "},
      {"blanks", "  before and after  "},
      {"blanks", "\u00a0no-break\u00a0"},
      {"line break", "a\nb"},
      {"line break", "a\r\nb"},
      {"line break", "\r"},
      {"line break", "\n"},
      {"tab", "\t"},
      {"forged log line", "FIC1\n2026-01-01T00:00:00Z error: results database: everything is lost"},
      {"forged log line", "FIC1\",\"level\":\"error\",\"x\":\""},
      {"terminal", "\x1b[2J\x1b[1;31mred"},
      {"terminal", "\x1b]0;title\x07"},
      {"terminal", "back\b\b\b\bspace"},
      {"terminal", "\u009b2J"},
      {"terminal", "\x7f\x0e\x0f"},
      {"direction", "\u202eDETRESER"},
      {"direction", "\u2067right\u2069\u200f"},
      {"invisible", "FIC\u200b101"},
      {"invisible", "\ufeff"},
      {"lines of Unicode", "a\u2028b\u2029c\u0085d"},
      {"spreadsheet", "=cmd|' /C calc'!A0"},
      {"spreadsheet", "+1+1"},
      {"spreadsheet", "-2+3"},
      {"spreadsheet", "@SUM(1,1)"},
      {"spreadsheet", "=HYPERLINK(\"http://example.com\",\"a\")"},
      {"file", "../../../../tmp/loopscope_hostile"},
      {"file", "/tmp/loopscope_hostile"},
      {"file", "."},
      {"file", ".."},
      {"file", "a/b\\c:d*e?f<g>h|i"},
      {"file", "CON"},
      {"option", "-"},
      {"option", "--help"},
      {"option", "--config=/dev/null"},
      {"shell", "$(touch loopscope_hostile)"},
      {"shell", "`id`; ${HOME} && true | cat > x &"},
      {"HTML", "<script>alert(1)</script>"},
      {"HTML", "\"><img src=x onerror=alert(1)>&amp;<!--"},
      {"XML", "]]>"},
      {"JSON", "\\u0000\\\"}"},
      {"URL", "%00%0a%2e%2e%2f?a=b&c#d"},
      {"label of a metric", "a\"} 1\nloopscope_overdue_loops 0"},
      {"letters", "F\u00fcllstand 20 \u00b0C"},
      {"letters", "Fu\u0308llstand 20 \u00b0C"},
      {"letters", "\u6db2\u4f4d\U0001F600\u200d\U0001F525"},
      {"letters", "\u0130\u0131\u00df\ufb01"},
      {"length", repeated("n", kLongestIdentifier)},
      {"length", repeated("n", kLongestIdentifier + 1)},
      {"length", repeated("\u00fc", 32)},
      {"length", repeated("0123456789", 50)},
      {"number", "0"},
      {"number", "1e400"},
      {"truth", "false"},
  };
  return names;
}

const std::vector<HostileName>& impossible_names() {
  static const std::vector<HostileName> names{{"zero byte", "a\0b"s},
                                              {"zero byte", "\0"s},
                                              {"no UTF-8", "\xff\xfe"},
                                              {"no UTF-8", "cut \xe2\x80"},
                                              {"overlong quote", "\xc0\xa7"},
                                              {"surrogate", "\xed\xa0\x80"},
                                              {"Latin-1", "F\xfcllstand 20 \xb0"}};
  return names;
}

std::vector<HostileName> hostile_identifiers() {
  std::vector<HostileName> names;
  std::ranges::copy_if(hostile_names(), std::back_inserter(names), [](const HostileName& name) {
    return name.name.size() <= kLongestIdentifier;
  });
  return names;
}

std::string hex(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string digits;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    digits += kDigits[byte / 16];
    digits += kDigits[byte % 16];
  }
  return digits;
}

std::string sql_text(std::string_view text) {
  return "convert_from('\\x" + hex(text) + "', 'UTF8')";
}

std::string sql_identifier(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + '"';
}

bool is_harmless_on_a_terminal(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
  };
  for (std::size_t k = 0; k < text.size(); ++k) {
    if ((byte(k) < 0x20 && text[k] != '\n') || byte(k) == 0x7F) return false;
    // U+0080 to U+009F, then U+200B, U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069, U+FEFF.
    if (byte(k) == 0xC2 && byte(k + 1) < 0xA0) return false;
    const bool general = byte(k) == 0xE2 && (byte(k + 1) == 0x80 || byte(k + 1) == 0x81);
    const unsigned last = byte(k + 2);
    if (general && byte(k + 1) == 0x80 &&
        (last == 0x8B || last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE)))
      return false;
    if (general && byte(k + 1) == 0x81 && last >= 0xA0 && last <= 0xAF) return false;
    if (text.substr(k).starts_with("\xEF\xBB\xBF")) return false;
  }
  return true;
}

}  // namespace loopscope::tests
