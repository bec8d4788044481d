// Visibility of the public symbols: everything else in the library is hidden.
#pragma once

#if defined(_WIN32)
#define VOROCL_API
#else
#define VOROCL_API __attribute__((visibility("default")))
#endif
