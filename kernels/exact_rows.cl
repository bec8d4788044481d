// Where seeds are dense: the nearest seed of each row, found among the row's bits, and then the best of the rows.
//
// Meant for a cell that holds a seed: no pixel of it is farther than REACH from its nearest seed along either axis.

#include "exact_cells.cl"

#define REACH (2 * (CELL - 1))
// A greater offset than there can be: the seed of a row that has none in reach.
#define OUT_OF_REACH (REACH + 1)
#define MOST_ROWS (CELL + 2 * REACH)

// The nearest seeds in the rows around a cell, for a run of the cell's pixels. Row 0 is REACH above the cell.
typedef struct {
  global const uint* bits;
  int width, height;
  int x, top;                   // the run's first pixel; the cell's first row
  int first, last;              // the rows found until now
  int_run along_x[MOST_ROWS];   // the distance's part along x
  uint_run seed[MOST_ROWS];     // packed
} NearestInRows;

inline void begin_rows(NearestInRows* rows, global const uint* bits, int x, int top, int width, int height) {
  rows->bits = bits;
  rows->width = width;
  rows->height = height;
  rows->x = x;
  rows->top = top;
  rows->first = REACH;
  rows->last = REACH - 1;
}

inline uint bits_at(global const uint* bits, int cell_x, int y, int columns) {
  return cell_x < 0 || cell_x >= columns ? 0 : row_bits(bits, (y >> CELL_BITS) * columns + cell_x, y & (CELL - 1));
}

// The nearest seed in one row, the left one of two.
inline void find_row(NearestInRows* rows, int row) {
  const int x = rows->x, y = rows->top - REACH + row;
  if (y < 0 || y >= rows->height) {
    rows->along_x[row] = (int_run)ALONG(OUT_OF_REACH);
    rows->seed[row] = (uint_run)EMPTY;
    return;
  }
  const int columns = cells_along(rows->width, 0), cell_x = x >> CELL_BITS;
  const uint_run own = bits_at(rows->bits, cell_x, y, columns);
  const uint_run before =
      bits_at(rows->bits, cell_x - 1, y, columns) << 16 | bits_at(rows->bits, cell_x - 2, y, columns);
  const uint_run behind =
      bits_at(rows->bits, cell_x + 1, y, columns) | bits_at(rows->bits, cell_x + 2, y, columns) << 16;
  // For each lane the 32 pixels that end with its own and the 32 that begin with it; the farthest one stands for a
  // seed that is out of reach.
  const uint_run lane = LANES + (uint)(x & (CELL - 1));
  const uint_run leftwards = own << (31 - lane) | before >> (lane + 1) | 1u;
  const uint_run rightwards = own >> lane | behind << (16 - lane) | 0x80000000u;
  const int_run left = 31 - highest_bits(leftwards), right = highest_bits(rightwards & -rightwards);
  const int_run offset = min(left, right);
  rows->along_x[row] = ALONG(offset);
  rows->seed[row] = run_positions(x, y) + AS_UINT_RUN(select(right, -left, left <= right));
}

// Finds what is missing of the rows from `first` to `last`.
inline void find_rows(NearestInRows* rows, int first, int last) {
  while (rows->first > first) {
    --rows->first;
    find_row(rows, rows->first);
  }
  while (rows->last < last) {
    ++rows->last;
    find_row(rows, rows->last);
  }
}
