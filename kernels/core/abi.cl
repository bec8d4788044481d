// clang warns that a processor without AVX-512 passes vectors of 64 bytes in another way, and a driver then says on
// standard error that there are warnings. No function of a program is called from elsewhere.

#if defined(__clang__) && defined(__x86_64__)
#pragma clang diagnostic ignored "-Wpsabi"
#endif

// What is written soon. (The function of PoCL does nothing; Oclgrind knows no other.)
#ifdef POCL_DEVICE_ADDRESS_BITS
#define PREFETCH(address) __builtin_prefetch(address, 1)
#else
#define PREFETCH(address) prefetch(address, 1)
#endif

// Whether a condition holds in some lane of a vector. (any() of PoCL 3.1 goes lane by lane. Oclgrind knows no other.)
#if defined(POCL_DEVICE_ADDRESS_BITS) && defined(__has_builtin)
#if __has_builtin(__builtin_reduce_or)
#define SOME(condition) (__builtin_reduce_or(condition) < 0)
#endif
#endif
#ifndef SOME
#define SOME(condition) any(condition)
#endif

// Stores a vector past the caches, if the compiler can: a line of them need not be read before it is written. For whole
// lines of images of so many pixels that no cache is taken to hold them.
#ifdef __has_builtin
#if __has_builtin(__builtin_nontemporal_store)
#define STREAM(vector, pointer) __builtin_nontemporal_store(vector, pointer)
#endif
#endif
#ifndef STREAM
#define STREAM(vector, pointer) (*(pointer) = (vector))
#endif
#define BYTES_OF_LINE 64
#define IS_STREAMED(pixels) ((pixels) > (1 << 22))
