// Whole numbers of 128 bits: sums of products of two numbers of 64.

#ifndef VOROCL_EXACT_CELLS_WIDE
#define VOROCL_EXACT_CELLS_WIDE

#include "core/abi.cl"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

typedef struct {
  ulong low;
  long high;
} wide_t;

// The upper halves of products: some compilers take many steps for mul_hi().
#ifdef __SIZEOF_INT128__
static inline ulong upper_half(ulong a, ulong b) { return (ulong)((unsigned __int128)a * b >> 64); }
static inline long upper_half_signed(long a, long b) { return (long)((__int128)a * b >> 64); }
#else
static inline ulong upper_half(ulong a, ulong b) { return mul_hi(a, b); }
static inline long upper_half_signed(long a, long b) { return mul_hi(a, b); }
#endif

static inline wide_t product(long a, long b) {
  const wide_t wide = {(ulong)a * (ulong)b, upper_half_signed(a, b)};
  return wide;
}

static inline wide_t sum(wide_t a, wide_t b) {
  const ulong low = a.low + b.low;
  const wide_t wide = {low, (long)((ulong)a.high + (ulong)b.high + (low < a.low ? 1u : 0u))};
  return wide;
}

static inline wide_t negative(wide_t a) {
  const wide_t wide = {0 - a.low, (long)(~(ulong)a.high + (a.low == 0 ? 1u : 0u))};
  return wide;
}

static inline int sign_of(wide_t wide) { return wide.high < 0 ? -1 : (wide.high != 0 || wide.low != 0); }

// Rounded: by less than 2^-52 of the number.
static inline double to_double(wide_t wide) {
  const bool is_negative = wide.high < 0;
  const wide_t size = is_negative ? negative(wide) : wide;
  const double rounded = convert_double((ulong)size.high) * 0x1p64 + convert_double(size.low);
  return is_negative ? -rounded : rounded;
}

#endif
