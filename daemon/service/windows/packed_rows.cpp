#include "daemon/service/windows/packed_rows.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>
#include <vector>
#include <zstd.h>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::RawSeries;

/// Fast: higher levels save a twentieth of the bytes of random mantissas and take three times as
/// long.
constexpr int kLevel = -1;
constexpr std::array kPowersOfTen{1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
constexpr std::int8_t kAsTheyAre = -1;
/// A missing value among whole numbers.
constexpr std::int32_t kMissingNumber = std::numeric_limits<std::int32_t>::min();

template <std::unsigned_integral Word>
Word zigzag(Word difference) {
  constexpr int kSign = std::numeric_limits<Word>::digits - 1;
  return static_cast<Word>((difference << 1) ^ (Word{0} - (difference >> kSign)));
}

template <std::unsigned_integral Word>
Word unzigzag(Word word) {
  return static_cast<Word>((word >> 1) ^ (Word{0} - (word & 1)));
}

/// Differences from word to word, small ones of either sign as small numbers; overflow wraps.
template <std::unsigned_integral Word>
void take_differences(std::vector<Word>& words) {
  Word before = 0;
  for (Word& word : words) word = zigzag<Word>(word - std::exchange(before, word));
}

template <std::unsigned_integral Word>
void sum_differences(std::vector<Word>& words) {
  Word sum = 0;
  for (Word& word : words) word = sum += unzigzag(word);
}

/// Appends the words byte by byte: all lowest bytes first.
template <std::unsigned_integral Word>
void append_by_bytes(const std::vector<Word>& words, std::string& text) {
  const std::size_t count = words.size();
  std::size_t at = text.size();
  text.resize(at + sizeof(Word) * count);
  for (unsigned shift = 0; shift < 8 * sizeof(Word); shift += 8) {
    for (std::size_t k = 0; k < count; ++k) text[at + k] = static_cast<char>(words[k] >> shift);
    at += count;
  }
}

template <std::unsigned_integral Word>
std::vector<Word> words_by_bytes(const char* bytes, std::size_t count) {
  std::vector<Word> words(count);
  for (unsigned shift = 0; shift < 8 * sizeof(Word); shift += 8) {
    for (Word& word : words) {
      word |= static_cast<Word>(Word{static_cast<unsigned char>(*bytes++)} << shift);
    }
  }
  return words;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The value as a whole number of grid steps, if it comes back from it bit for bit.
std::optional<std::int32_t> whole_number(double value, double steps) {
  if (same_bits(value, core::signal::kMissing)) return kMissingNumber;
  const double number = std::nearbyint(value * steps);
  if (!(std::abs(number) < -static_cast<double>(kMissingNumber))) return std::nullopt;
  const auto whole = static_cast<std::int32_t>(number);
  return same_bits(whole / steps, value) ? std::optional(whole) : std::nullopt;
}

std::optional<std::vector<std::uint32_t>> whole_numbers(std::span<const double> values,
                                                        double steps) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(values.size());
  for (const double value : values) {
    const auto number = whole_number(value, steps);
    if (!number) return std::nullopt;
    numbers.push_back(static_cast<std::uint32_t>(*number));
  }
  return numbers;
}

/// Appends the values; returns the decimals of their grid.
std::int8_t append_values(std::span<const double> values, std::string& text) {
  for (std::size_t decimals = 0; decimals < kPowersOfTen.size(); ++decimals) {
    auto numbers = whole_numbers(values, kPowersOfTen[decimals]);
    if (!numbers) continue;
    take_differences(*numbers);
    append_by_bytes(*numbers, text);
    return static_cast<std::int8_t>(decimals);
  }
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  append_by_bytes(bits, text);
  return kAsTheyAre;
}

std::vector<double> take_values(const char* bytes, std::size_t count, std::int8_t decimals) {
  std::vector<double> values;
  values.reserve(count);
  if (decimals == kAsTheyAre) {
    for (const std::uint64_t bits : words_by_bytes<std::uint64_t>(bytes, count)) {
      values.push_back(std::bit_cast<double>(bits));
    }
    return values;
  }
  auto numbers = words_by_bytes<std::uint32_t>(bytes, count);
  sum_differences(numbers);
  const double steps = kPowersOfTen[static_cast<std::uint8_t>(decimals)];
  for (const std::uint32_t word : numbers) {
    const auto number = static_cast<std::int32_t>(word);
    values.push_back(number == kMissingNumber ? core::signal::kMissing : number / steps);
  }
  return values;
}

std::string compress(const std::string& text) {
  // Its tables are worth keeping: they are larger than what is packed.
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                                  &ZSTD_freeCCtx);
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  const std::size_t size = context ? ZSTD_compressCCtx(context.get(), packed.data(), packed.size(),
                                                       text.data(), text.size(), kLevel)
                                   : 0;
  if (!context || ZSTD_isError(size) != 0) throw std::bad_alloc();
  return {packed.data(), size};
}

std::string decompress(const std::string& packed, std::size_t size) {
  std::string text(size, '\0');
  const std::size_t found = ZSTD_decompress(text.data(), size, packed.data(), packed.size());
  // Only what was compressed here comes here: nothing but memory can be lacking.
  if (ZSTD_isError(found) != 0 || found != size) throw std::bad_alloc();
  return text;
}

}  // namespace

PackedRows::PackedRows(const RawSeries& rows)
    : rows_(static_cast<std::uint32_t>(rows.time_us.size())), hold_(rows.hold) {
  std::vector<std::uint64_t> times;
  times.reserve(rows.time_us.size());
  for (const std::int64_t time_us : rows.time_us) {
    times.push_back(static_cast<std::uint64_t>(time_us));
  }
  take_differences(times);
  take_differences(times);
  std::string text;
  text.reserve(2 * sizeof(std::uint64_t) * rows.time_us.size());
  append_by_bytes(times, text);
  decimals_ = append_values(rows.value, text);
  packed_ = compress(text);
}

RawSeries PackedRows::unpack() const {
  RawSeries rows;
  rows.hold = hold_;
  if (packed_.empty()) return rows;
  const std::size_t of_times = sizeof(std::uint64_t) * rows_;
  const std::size_t of_values =
      (decimals_ == kAsTheyAre ? sizeof(std::uint64_t) : sizeof(std::uint32_t)) * rows_;
  const std::string text = decompress(packed_, of_times + of_values);
  auto times = words_by_bytes<std::uint64_t>(text.data(), rows_);
  sum_differences(times);
  sum_differences(times);
  rows.time_us.reserve(rows_);
  for (const std::uint64_t time : times) rows.time_us.push_back(static_cast<std::int64_t>(time));
  rows.value = take_values(text.data() + of_times, rows_, decimals_);
  return rows;
}

}  // namespace loopscope::daemon
