#pragma once

#include <span>
#include <string>

namespace loopscope::daemon {

// Series as a page's script reads them: JSON of digits, commas and base64 (RFC 4648, section 4),
// nothing that could end the attribute or the element in which it stands.

/// `samples` (NaN = missing) in single precision, which keeps six digits of any value: either
/// "[count,value,count,value,...]" of runs of equal values, null = missing, or, where that is
/// shorter, a string of little-endian IEEE 754 numbers in base64, NaN = missing. What is too large
/// for single precision becomes its largest number.
[[nodiscard]] std::string sample_text(std::span<const double> samples);

/// Which of `samples` are there: a string of bits in base64, the lowest bit of a byte first.
[[nodiscard]] std::string presence_text(std::span<const double> samples);

}  // namespace loopscope::daemon
