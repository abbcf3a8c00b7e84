#pragma once

/// toml++ as every file of this project includes it: with one setting of its macros, since two
/// settings in one program clash (the parser with exceptions and the one without share inline
/// functions). Slow to compile: only for the files that parse.
#ifndef TOML_EXCEPTIONS
#define TOML_EXCEPTIONS 0
#endif
// toml++ 3.3 asserts that a table's header begins like a key before it reports "[=]" and its like as
// wrong syntax. A user's slip must not end a Debug build, so the assertions are off.
#define TOML_ASSERT(expression) static_assert(true)
#ifndef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1
#endif
#include <toml++/toml.h>
