// The extent of each cell of a volume: its bounding box, and the largest distance to the seed.

#include "measures/runs.cl"
#include "volumes/position.cl"

// A box is left, top, front, right, bottom, back.
#define SIDES 6

static inline void clear_shape(uint id, global int* boxes, global int* distances) {
  for (int side = 0; side < SIDES; ++side) boxes[SIDES * (size_t)id + (size_t)side] = side < 3 ? INT_MAX : INT_MIN;
  distances[id] = -1;
}

kernel void clear_shapes(uint count, global int* restrict boxes, global int* restrict distances) {
  const uint id = (uint)get_global_id(0);
  if (id < count) clear_shape(id, boxes, distances);
}

// As in kernels/measures/shapes.cl a run adds only what the rows beside it leave to it: those above, below, in front
// and behind. A row that is not there is the row itself, in which no voxel decides. The middle of a run says best
// whether the cell goes on in the next row: at its ends the cell's border runs in and out.
kernel void add_shapes(global const uint* restrict labels, global const uint* restrict positions, uint count, int width,
                       int height, int rows, int wide, int high, global int* restrict boxes,
                       global int* restrict distances) {
  block_t block;
  if (!take_block(width, rows, wide, high, &block)) return;
  const size_t across = (size_t)width, slice = across * (size_t)height;
  for (int at = block.top; at < block.bottom; ++at) {
    const int y = at % height, z = at / height;
    const bool has_above = y > 0, has_below = y + 1 < height, has_front = z > 0, has_back = at + height < rows;
    global const uint* const row = labels + (size_t)at * across;
    global const uint* const above = has_above ? row - across : row;
    global const uint* const below = has_below ? row + across : row;
    global const uint* const front = has_front ? row - slice : row;
    global const uint* const back = has_back ? row + slice : row;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const int first = walk.from, last = walk.to - 1, middle = (first + last) / 2;
      global int* const box = boxes + SIDES * (size_t)label;
      if (first == 0 || !(row[first - 1] == label || above[first - 1] == label || below[first - 1] == label ||
                          front[first - 1] == label || back[first - 1] == label)) {
        atomic_min(box, first);
      }
      if (last + 1 == width || !(row[last + 1] == label || above[last + 1] == label || below[last + 1] == label ||
                                 front[last + 1] == label || back[last + 1] == label)) {
        atomic_max(box + 3, last);
      }
      if (!has_above || above[middle] != label) atomic_min(box + 1, y);
      if (!has_front || front[middle] != label) atomic_min(box + 2, z);
      if (!has_below || below[middle] != label) atomic_max(box + 4, y);
      if (!has_back || back[middle] != label) atomic_max(box + 5, z);

      const uint seed = positions[label];
      const int way_y = y - y_of(seed), way_z = z - z_of(seed);
      const int beside = ALONG(way_y) + ALONG(way_z);
      global const uint* const away_y = way_y < 0 ? above : below;
      global const uint* const away_z = way_z < 0 ? front : back;
      const int first_way = first - x_of(seed), last_way = last - x_of(seed);
      if ((away_y == row || away_y[first] != label) && (away_z == row || away_z[first] != label)) {
        atomic_max(distances + label, beside + ALONG(first_way));
      }
      if ((away_y == row || away_y[last] != label) && (away_z == row || away_z[last] != label)) {
        atomic_max(distances + label, beside + ALONG(last_way));
      }
    }
  }
}

// Seeds that are absent own nothing, whatever labels name them.
kernel void clear_absent(global const uint* restrict positions, uint count, global int* restrict boxes,
                         global int* restrict distances) {
  const uint id = (uint)get_global_id(0);
  if (id < count && (positions[id] & EMPTY)) clear_shape(id, boxes, distances);
}
