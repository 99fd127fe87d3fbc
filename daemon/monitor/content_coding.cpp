#include "daemon/monitor/content_coding.hpp"

#include <algorithm>
#include <charconv>
#include <memory>
#include <new>
#include <stdexcept>
#define ZLIB_CONST  // what is compressed is not written to
#include <zlib.h>

#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

/// Of identity where nobody speaks of it: acceptable, after whatever is asked for.
constexpr double kUnasked = 1e-6;

/// What stands before the separator; it is taken off `text` together with it.
std::string_view take_until(std::string_view& text, char separator) {
  const std::string_view part = text.substr(0, text.find(separator));
  text.remove_prefix(std::min(text.size(), part.size() + 1));
  return trimmed(part);
}

/// The number of "q=0.5": 0 to 1; nullopt = it is none.
std::optional<double> weight(std::string_view parameter) {
  if (!same_word(parameter.substr(0, 2), "q=")) return std::nullopt;
  const std::string_view number = parameter.substr(2);
  double value = -1.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  const bool whole = error == std::errc() && end == number.data() + number.size();
  return whole && value >= 0.0 && value <= 1.0 ? std::optional(value) : std::nullopt;
}

}  // namespace

AcceptedCodings accepted_codings(const std::optional<std::string>& header) {
  if (!header) return {};
  std::optional<double> identity, gzip, others;
  std::string_view rest = *header;
  while (!rest.empty()) {
    std::string_view element = take_until(rest, ',');
    const std::string_view coding = take_until(element, ';');
    const std::string_view parameter = trimmed(element);
    const std::optional<double> q = parameter.empty() ? 1.0 : weight(parameter);
    if (!q) continue;
    if (same_word(coding, "identity")) identity = q;
    if (same_word(coding, "gzip") || same_word(coding, "x-gzip")) gzip = q;
    if (coding == "*") others = q;
  }
  return {identity.value_or(others.value_or(kUnasked)), gzip.value_or(others.value_or(0.0))};
}

std::string gzip(std::string_view text) {
  constexpr int kLargestWindow = 15;
  constexpr int kGzipHeader = 16;
  constexpr int kUsualMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kLargestWindow + kGzipHeader,
                   kUsualMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> until_end(&stream, deflateEnd);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(text.data());
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END)
    throw std::runtime_error("gzip: zlib did not come to an end");
  packed.resize(stream.total_out);
  return packed;
}

}  // namespace loopscope::daemon
