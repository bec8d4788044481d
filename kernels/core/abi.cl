// clang warns that a processor without AVX-512 passes vectors of 64 bytes in another way, and a driver then says on
// standard error that there are warnings. No function of a program is called from elsewhere.

#if defined(__clang__) && defined(__x86_64__)
#pragma clang diagnostic ignored "-Wpsabi"
#endif
