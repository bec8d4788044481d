// Where seeds are dense: the nearest seed of each row, found among the row's bits, and then the best of the rows.
//
// A row of a cell is one vector of CELL lanes here, whatever VOROCL_WIDTH is. Rows up to REACH above and below the cell
// take part, and in each row the cells to the left and right: a seed at REACH or nearer is among those.

#include "exact_cells.cl"

#define REACH (CELL - 1)
#define ROWS_IN_REACH (CELL + 2 * REACH)
#define CELL_LANES ((short16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

// A pixel's ROW KEY of a row: the distance to the row's nearest seed, and in the lowest bits how far down the row is,
// so that of rows at equal distances the upper one has the least key.
#define OFFSET_BITS 5
#define ROW_KEY(distance, offset) (((distance) << OFFSET_BITS) + (offset) + REACH)
// What stands for the distance to the seed of a row that has none near: more than any other, and the key fits.
#define NO_SEED_NEAR 1250

// The nearest seeds in the rows around a cell. Row 0 is REACH above the cell.
typedef struct {
  const Listing* all;
  int cell_x, top;                   // the cell's column of cells; its first row
  ushort16 along_x[ROWS_IN_REACH];   // the part along x of a row key
  uint label[ROWS_IN_REACH * CELL];  // of the row's nearest seeds
} NearestInRows;

// The place in the list of the first seed in a row of a cell, given the word that holds the row.
inline uint first_listed(const Listing* all, int word, int y) {
  return listed(all->bits, all->word_starts, (uint)(word * 32 + y % ROWS_OF_WORD * CELL));
}

// The nearest seed of each lane, in the two halves of 32-bit lanes that a vector of 256 bits can hold.
typedef struct {
  short16 x;  // from the cell's left edge
  uint8 first_labels, last_labels;
  int last_x;
} NearestInRow;

// A seed to the right of the others takes over where the middle between it and the last one is passed.
inline void pass_over(NearestInRow* nearest, int x, uint label) {
  const short16 nearer = CELL_LANES * (short)2 > (short16)(short)(nearest->last_x + x);
  nearest->x = select(nearest->x, (short16)(short)x, nearer);
  nearest->first_labels = select(nearest->first_labels, (uint8)label, convert_int8(nearer.lo));
  nearest->last_labels = select(nearest->last_labels, (uint8)label, convert_int8(nearer.hi));
  nearest->last_x = x;
}

// A row's nearest seeds, of two the left one. Of the cells at the left and right only the seed next to this cell counts,
// and one far away if there is none: without a branch, which would be taken as often as not.
#define FAR_AWAY 128
inline void find_row(NearestInRows* rows, int row) {
  const Listing* const all = rows->all;
  const int y = rows->top - REACH + row;
  if (y < 0 || y >= all->height) {
    rows->along_x[row] = (ushort16)(NO_SEED_NEAR << OFFSET_BITS);
    return;
  }
  const int word = ((y >> CELL_BITS) * all->columns + rows->cell_x) * WORDS + y % CELL / ROWS_OF_WORD;
  const uint before = rows->cell_x == 0 ? 0 : row_bits(all->bits[word - WORDS], y);
  const uint behind = rows->cell_x == all->columns - 1 ? 0 : row_bits(all->bits[word + WORDS], y);
  const uint last_before = before == 0 ? 0 : first_listed(all, word - WORDS, y) + popcount(before) - 1;
  const uint first_behind = behind == 0 ? 0 : first_listed(all, word + WORDS, y);
  NearestInRow nearest;
  nearest.last_x = before == 0 ? -FAR_AWAY : 31 - (int)clz(before) - CELL;
  nearest.x = (short16)(short)nearest.last_x;
  nearest.first_labels = nearest.last_labels = (uint8)all->ids[last_before];
  uint at = first_listed(all, word, y);
  for (uint seeds = row_bits(all->bits[word], y); seeds != 0; seeds &= seeds - 1) {
    pass_over(&nearest, (int)lowest_bit(seeds), all->ids[at++]);
  }
  pass_over(&nearest, behind == 0 ? FAR_AWAY : (int)lowest_bit(behind) + CELL, all->ids[first_behind]);
  const short16 offset = nearest.x - CELL_LANES;
  rows->along_x[row] = as_ushort16(min(ALONG(offset), (short16)NO_SEED_NEAR)) << (ushort)OFFSET_BITS;
  vstore8(nearest.first_labels, 0, rows->label + row * CELL);
  vstore8(nearest.last_labels, 1, rows->label + row * CELL);
}

// Whether some lane is not below a limit.
inline bool any_from(ushort16 values, ushort limit) {
  const ulong4 lanes = as_ulong4(values >= (ushort16)limit);
  return (lanes.s0 | lanes.s1 | lanes.s2 | lanes.s3) != 0;
}

// Finds the least row keys of the cell's first `count` rows, going from each row up and down until no row farther away
// can have a nearer seed. False if that would go beyond the reach.
inline bool find_least_row_keys(NearestInRows* rows, int count, ushort16* least) {
  ushort16 worst = (ushort16)0;
  for (int y = 0; y < count; ++y) {
    find_row(rows, REACH + y);
    least[y] = rows->along_x[REACH + y] + (ushort)ROW_KEY(0, 0);
    worst = max(worst, least[y]);
  }
  for (int offset = 1; any_from(worst, (ushort)ROW_KEY(ALONG(offset), -REACH)); ++offset) {
    if (offset > REACH) return false;
    find_row(rows, REACH - offset);
    find_row(rows, REACH + count - 1 + offset);
    const ushort above = (ushort)ROW_KEY(ALONG(offset), -offset), below = (ushort)ROW_KEY(ALONG(offset), offset);
    worst = (ushort16)0;
    for (int y = 0; y < count; ++y) {
      const ushort16 to_above = rows->along_x[REACH + y - offset] + above;
      const ushort16 to_below = rows->along_x[REACH + y + offset] + below;
      least[y] = min(least[y], min(to_above, to_below));
      worst = max(worst, least[y]);
    }
  }
  return true;
}
