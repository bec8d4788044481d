/* Visibility of the public symbols: everything else in the library is hidden. For C and C++. */
#ifndef VOROCL_EXPORT_H
#define VOROCL_EXPORT_H

#if defined(_WIN32)
#define VOROCL_API
#else
#define VOROCL_API __attribute__((visibility("default")))
#endif

#endif
