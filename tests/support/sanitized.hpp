#pragma once

namespace loopscope::tests {

/// True in a build whose sanitizer takes terabytes of address space for itself, so that no limit of
/// memory can be set for a program.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace loopscope::tests
