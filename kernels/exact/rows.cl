// Labelling a bin where seeds are dense: the nearest seed of each row, found among the row's bits, and then the best of
// the rows.
//
// A row of a bin is one vector of BIN lanes here, whatever VOROCL_WIDTH is. Rows up to REACH above and below the bin
// take part, and in each row the bins to the left and right.

#ifndef VOROCL_EXACT_ROWS
#define VOROCL_EXACT_ROWS

#include "exact/box.cl"

#if BIN_BITS != 4
#error "A row of a bin is not a vector of 16 lanes"
#endif
#if REACH >= 1 << BIN_BITS
#error "A seed within reach of a bin may lie beyond the bins next to it"
#endif
#define ROWS_IN_REACH (PAIR * BIN + 2 * REACH)
#define BIN_LANES ((short16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

// A pixel's ROW KEY of a row: the distance to the row's nearest seed, and in the lowest bits the row's number, so that
// of rows at equal distances the one with the least number has the least key.
#define NUMBER_BITS 6
// What stands for the part along x where a row has no seed near: a distance beyond the reach.
#define NO_SEED_NEAR ((REACH + 1) * (REACH + 1))
#if ROWS_IN_REACH > 1 << NUMBER_BITS || (NO_SEED_NEAR + REACH * REACH + 1) << NUMBER_BITS > 0xffff
#error "A row key does not fit in a ushort"
#endif

// The ids of a row: of the last seed in the bin at the left, of the seeds in the row of the bin, of the first one in
// the bin at the right.
#define IDS_OF_ROW (BIN + 2)
#if ((PAIR << BIN_BITS) + 2 * REACH) * ((1 << BIN_BITS) + 2) > 0xffff
#error "A place among the ids of all rows does not fit in a ushort"
#endif

// The nearest seeds in the rows of a pair of bins and around it.
typedef struct {
  const SeedIndex* index;
  int bin_x, top;                    // the pair's column of bins; the row of the frame that is the topmost here
  int first_column, first_row;       // where the grid begins again among the pixels around: see number_of_row()
  int begin, end;                    // the rows that have been found
  ushort16 along_x[ROWS_IN_REACH];   // a row key without the distance along y
  ushort16 nearest[ROWS_IN_REACH];   // by the row's number: its nearest seed, as a place in:
  uint ids[ROWS_IN_REACH * IDS_OF_ROW];
} NearestInRows;

static inline void begin_rows(NearestInRows* rows, const SeedIndex* index, int bin_x, int bin_y) {
  rows->index = index;
  rows->bin_x = bin_x;
  rows->top = bin_y * BIN - REACH;
  rows->begin = rows->end = 0;
#ifdef VOROCL_PERIODIC
  rows->first_row =
      PERIODIC_Y ? first_of_period(rows->top, ROWS_IN_REACH, margin_y(index->height), index->height, 0) : 0;
  rows->first_column =
      PERIODIC_X ? first_of_period((bin_x - 1) * BIN, 3 * BIN, margin_x(index->width), index->width, 0) - BIN : -BIN;
#endif
}

// The rows are numbered in the order of the tie rule: from above to below, but where the border between two periods
// lies in between, those behind it come first.
static inline int number_of_row(const NearestInRows* rows, int row) {
#ifdef VOROCL_PERIODIC
  return row >= rows->first_row ? row - rows->first_row : row - rows->first_row + ROWS_IN_REACH;
#else
  (void)rows;
  return row;
#endif
}

// The place of the only bit, or of the highest one of 16, that is set in each lane, by the exponent of a float; -127
// where none is.
static inline short16 place_of_bit(int8 first, int8 last) {
  const int8 first_places = as_int8(convert_float8(first)) >> 23, last_places = as_int8(convert_float8(last)) >> 23;
  return (short16)(as_short16(first_places).even, as_short16(last_places).even) - (short)127;
}

// How many of the lowest 1, 2, ... 8 bits are set, a byte each: they are spread to bytes, and a product sums those.
#define ONES 0x0101010101010101ul
static inline ulong count_up(uint bits) {
  const ulong spread = (((bits & 0xffu) * ONES & 0x8040201008040201ul) + 0x7f * ONES) >> 7 & ONES;
  return spread * ONES;
}

// The seeds in a row of a bin, given the word that holds it, and the places in the list of the first and last one, any
// places if there is none. The mask stands for a condition, of which compilers make a branch.
typedef struct {
  uint bits, first, last;
} RowOfBin;
static inline RowOfBin row_of_bin(const SeedIndex* index, int word, int y, bool in_grid) {
  const int at = in_grid ? word : 0;
  const uint bits = index->bits[at], above = bits & ((1u << y % ROWS_OF_WORD * BIN) - 1);
  RowOfBin row;
  row.bits = in_grid ? row_bits(bits, y) : 0;
  const uint any = (uint)(-(int)row.bits >> 31);
  row.first = (index->word_starts[at] + popcount(above)) & any;
  row.last = row.first + popcount(row.bits) + any;
  return row;
}

// A row's nearest seeds: a pixel's is the last one up to it or the first one behind it, of two at equal distances the
// left one, unless the border between two periods lies in between. Without a branch or a loop, which would go one way
// as often as the other. Of the bins at the left and right only the seed next to this bin counts, and one FAR_AWAY if
// there is none; the right one's last pixel is out of reach.
#define FAR_AWAY 128
#if FAR_AWAY < 3 << BIN_BITS
#error "A seed that is not there may be nearer than one in the bin at the other side"
#endif
#if FAR_AWAY - (1 << BIN_BITS) <= REACH
#error "A seed that is not there may be within reach"
#endif
#if (FAR_AWAY + (1 << BIN_BITS)) * (FAR_AWAY + (1 << BIN_BITS)) > 0x7fff
#error "The square of the way to a seed that is not there does not fit in a short"
#endif
#define UP_TO_FIRST_LANES ((int8)(0x1, 0x3, 0x7, 0xf, 0x1f, 0x3f, 0x7f, 0xff))
#define UP_TO_LAST_LANES (UP_TO_FIRST_LANES << 8 | 0xff)
static inline void find_row(NearestInRows* rows, int row) {
  const SeedIndex* const index = rows->index;
  const int y = rows->top + row, number = number_of_row(rows, row);
  if (y < 0 || y >= frame_height(index->height)) {
    rows->along_x[row] = (ushort16)(ushort)(NO_SEED_NEAR << NUMBER_BITS | number);
    return;
  }
  const int word = ((y >> BIN_BITS) * index->columns + rows->bin_x) * WORDS + y % BIN / ROWS_OF_WORD;
  const RowOfBin own = row_of_bin(index, word, y, true);
  const RowOfBin before = row_of_bin(index, word - WORDS, y, rows->bin_x > 0);
  const RowOfBin behind = row_of_bin(index, word + WORDS, y, rows->bin_x < index->columns - 1);
  const int last_before = before.bits == 0 ? -FAR_AWAY : 31 - (int)clz(before.bits) - BIN;
  const int8 up_to_first = (int)own.bits & UP_TO_FIRST_LANES, up_to_last = (int)own.bits & UP_TO_LAST_LANES;
  const short16 left = max(place_of_bit(up_to_first, up_to_last), (short16)(short)last_before);
  const int to_come = (int)(own.bits | (behind.bits & ALL_BITS >> 1) << BIN);
  const int8 behind_first = to_come & ~UP_TO_FIRST_LANES, behind_last = to_come & ~UP_TO_LAST_LANES;
  const ushort16 place = as_ushort16(place_of_bit(behind_first & -behind_first, behind_last & -behind_last));
  const short16 right = as_short16(min(place, (ushort16)FAR_AWAY));
#ifdef VOROCL_PERIODIC
  // 1 where the border lies between the two, so that the right one comes first. By arithmetic, not by comparisons, of
  // whose single bits Oclgrind makes other numbers.
  const short16 zero = (short16)(short)0, one = (short16)(short)1, first_column = (short16)(short)rows->first_column;
  const short16 right_first = clamp(first_column - left, zero, one) & clamp(right - first_column + one, zero, one);
  const short16 nearer = (left + right - BIN_LANES * (short)2 - right_first) >> (short16)(short)15;
#else
  const short16 nearer = (left + right - BIN_LANES * (short)2) >> (short16)(short)15;
#endif
  const short16 offset = select(left, right, nearer) - BIN_LANES;
  rows->along_x[row] =
      as_ushort16(min(ALONG(offset), (short16)NO_SEED_NEAR)) << (ushort)NUMBER_BITS | (ushort)number;

  const ulong2 counts = (ulong2)(count_up(own.bits), count_up(own.bits >> 8) + popcount(own.bits & 0xffu) * ONES);
  const short16 up_to = convert_short16(as_uchar16(counts));
  rows->nearest[number] = as_ushort16(up_to - nearer) + (ushort)(number * IDS_OF_ROW);
  uint* const ids = rows->ids + number * IDS_OF_ROW;
  ids[0] = index->ids[before.last];
  vstore8(vload8(0, index->ids + own.first), 0, ids + 1);
  vstore8(vload8(1, index->ids + own.first), 1, ids + 1);
  ids[1 + popcount(own.bits)] = index->ids[behind.first];
}

// Whether some lane is not below a limit.
static inline bool any_from(ushort16 values, ushort limit) {
  const ulong4 lanes = as_ulong4(values >= (ushort16)limit);
  return (lanes.s0 | lanes.s1 | lanes.s2 | lanes.s3) != 0;
}

// Finds a row unless the pair's first bin did: the rows that have been found follow each other.
static inline void need_row(NearestInRows* rows, int row) {
  if (rows->begin <= row && row < rows->end) return;
  find_row(rows, row);
  rows->begin = min(rows->begin, row);
  rows->end = max(rows->end, row + 1);
}

// Finds the least row keys of the `count` rows of a bin, which begin at row `first`, going from each row up and down
// until no row farther away can have a nearer seed. False if that would go beyond the reach.
static inline bool find_least_row_keys(NearestInRows* rows, int first, int count, ushort16* least) {
  if (rows->end < first) rows->begin = rows->end = first;
  ushort16 worst = (ushort16)0;
  for (int y = 0; y < count; ++y) {
    need_row(rows, first + y);
    least[y] = rows->along_x[first + y];
    worst = max(worst, least[y]);
  }
  for (int offset = 1; any_from(worst, (ushort)(ALONG(offset) << NUMBER_BITS)); ++offset) {
    if (offset > REACH) return false;
    need_row(rows, first - offset);
    need_row(rows, first + count - 1 + offset);
    const ushort along_y = (ushort)(ALONG(offset) << NUMBER_BITS);
    worst = (ushort16)0;
    for (int y = 0; y < count; ++y) {
      least[y] = min(least[y], min(rows->along_x[first + y - offset], rows->along_x[first + y + offset]) + along_y);
      worst = max(worst, least[y]);
    }
  }
  return true;
}

// Labels a bin of the rows' pair by the best of the rows' nearest seeds; false if there is a pixel that has none within
// reach.
static inline bool label_by_rows(NearestInRows* rows, int bin_y, global uint* labels) {
  const SeedIndex* const index = rows->index;
  const int left = rows->bin_x * BIN, top = bin_y * BIN;
  const int count = min(BIN, index->y0 + index->height - top);
  ushort16 least[BIN];
  if (!find_least_row_keys(rows, top - rows->top, count, least)) return false;
  for (int y = 0; y < count; ++y) least[y] = (least[y] & (ushort)((1 << NUMBER_BITS) - 1)) * (ushort)BIN;
  // Gathered first and stored in vectors then, the labels fit in a CPU's store buffer, and it need not wait for memory.
  uint label[BIN * BIN];
  for (int y = 0; y < count; ++y) {
    const ushort* const nearest = (const ushort*)rows->nearest;
    const ushort* const row = (const ushort*)(least + y);
#pragma unroll
    for (int x = 0; x < BIN; ++x) label[y * BIN + x] = rows->ids[nearest[row[x] + x]];
  }
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < BIN; x += VOROCL_WIDTH) {
      store_in_row(index, LOAD_VECTOR(label + y * BIN + x), labels, left + x, top + y);
    }
  }
  return true;
}

#endif
