// For tools/checks/kernels.sh, instead of the compiler's own: min(), max() and clamp() without those of
// vectors of integers whose bounds are numbers. Oclgrind reads such a bound as a vector, with what lies
// behind it in memory.

#define ALLOWED __attribute__((overloadable))
#define REFUSED \
  __attribute__((overloadable, unavailable("Oclgrind reads a bound that is a number as a vector")))
#define CALLS(kind, type, bound) \
  kind type min(type, bound);    \
  kind type max(type, bound);    \
  kind type clamp(type, bound, bound);
#define CALLS_OF_VECTORS(number, vector, kind) CALLS(ALLOWED, vector, vector) CALLS(kind, vector, number)
#define CALLS_OF(type, kind)            \
  CALLS(ALLOWED, type, type)            \
  CALLS_OF_VECTORS(type, type##2, kind) \
  CALLS_OF_VECTORS(type, type##3, kind) \
  CALLS_OF_VECTORS(type, type##4, kind) \
  CALLS_OF_VECTORS(type, type##8, kind) \
  CALLS_OF_VECTORS(type, type##16, kind)
CALLS_OF(char, REFUSED)
CALLS_OF(uchar, REFUSED)
CALLS_OF(short, REFUSED)
CALLS_OF(ushort, REFUSED)
CALLS_OF(int, REFUSED)
CALLS_OF(uint, REFUSED)
CALLS_OF(long, REFUSED)
CALLS_OF(ulong, REFUSED)
CALLS_OF(float, ALLOWED)
CALLS_OF(double, ALLOWED)
