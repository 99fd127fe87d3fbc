#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace loopscope::storage {

/// Builds the text of a PostgreSQL array for a parameter `$n::type[]`: a batch of rows travels as
/// one array per column, so that a statement is parsed once and needs one round trip.
class ArrayLiteral {
 public:
  void add_null();
  void add_integer(std::int64_t value);
  void add_boolean(bool value);
  /// Shortest text that reads back as the same value; what is not finite becomes NULL, because
  /// "unknown" is null everywhere in the results.
  void add_number(std::optional<double> value);
  /// timestamp_text() of microseconds UTC since 1970.
  void add_time(std::int64_t time_us);
  /// Quoted; bytes that PostgreSQL refuses are replaced (make_storable).
  void add_text(std::string_view value);
  /// A whole text[] as ONE element, to be cast `::text[]` per row: unnest() would flatten a
  /// two-dimensional array.
  void add_text_list(std::span<const std::string> values);
  /// Likewise of numbers, to be cast `::real[]`; an empty list becomes NULL. What is too near to 0
  /// for four bytes, which PostgreSQL refuses, is 0.
  void add_real_list(std::span<const std::optional<double>> values);

  [[nodiscard]] bool empty() const { return elements_.empty(); }

  /// "{...}"; the object can still be added to.
  [[nodiscard]] std::string text() const { return "{" + elements_ + "}"; }

 private:
  void add_element(std::string_view raw);
  std::string elements_;
};

/// Shortest text that reads back as the same double: "nan", "inf" and "-inf" included.
[[nodiscard]] std::string number_text(double value);

}  // namespace loopscope::storage
