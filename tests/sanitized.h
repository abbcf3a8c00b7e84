#pragma once

/// What tests have to know of the sanitizers that they and the program are compiled with.
namespace sanitized {

#ifdef __SANITIZE_ADDRESS__
/// The address sanitizer ends a process whose memory is exhausted by itself, and has a report of its own.
inline constexpr bool memory_can_be_limited = false;
/// How many times as long the same work may take: a limit of time against a hang is longer by it.
inline constexpr int slowness = 30;
#else
inline constexpr bool memory_can_be_limited = true;
inline constexpr int slowness = 1;
#endif

/// How often a test does the same over again, as with other seeds, if it is `natively` often elsewhere: what the
/// sanitizers look at has run after a few.
constexpr int repetitions(int natively) { return slowness == 1 ? natively : (natively + 4) / 5; }

inline constexpr const char *no_limit_of_memory =
    "the address sanitizer ends a process whose memory is exhausted, before the program can";

} // namespace sanitized
