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
