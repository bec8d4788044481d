// What the operating system says of this process. Where it is none of Unix's kind, little is known.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#if defined(__unix__) || defined(__APPLE__)
#define VOROCL_IS_UNIX 1
#else
#define VOROCL_IS_UNIX 0
#endif

namespace vorocl {

/// A variable of the environment; empty where it is not set.
std::string environment(const char* name);

/// A number that a forked child does not share with its parent; always 0 where nothing forks.
std::int64_t process_number();

/// Throws Error if this is a forked child of the process with that number, which has used the driver: a fork
/// takes no threads along, and calls would wait for the driver's without end.
void refuse_fork_of(std::int64_t process);

/// The most bytes of addresses that the process may have; none: as many as there are.
std::optional<std::uint64_t> address_space_limit();

/// The features of the processor that programs may be compiled for, in any form; empty where nothing says
/// them.
std::string processor_features();

/// Makes the folder where PoCL keeps what it builds if it is not there. Why PoCL cannot write there, and what
/// to do; empty if it can.
std::string trouble_with_cache_of_pocl();

}  // namespace vorocl
