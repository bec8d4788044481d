// The extent of each cell of a volume: its bounding box, where place.cl says that its voxels lie, and the largest
// distance to the seed.

#include "measures/runs.cl"
#include "volumes/place.cl"

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
// and behind. A row that is not there, or where the way from the seed jumps, is the row itself, in which no voxel
// decides. The middle of a run says best whether the cell goes on in the next row: at its ends the cell's border runs
// in and out.
kernel void add_shapes(global const uint* restrict labels, global const uint* restrict positions, uint count, int width,
                       int height, int rows, int wide, int high, global int* restrict boxes,
                       global int* restrict distances) {
  block_t block;
  if (!take_block(width, rows, wide, high, &block)) return;
  const int depth = rows / height;
  const size_t across = (size_t)width, slice = across * (size_t)height;
  for (int at = block.top; at < block.bottom; ++at) {
    const int y = at % height, z = at / height;
    global const uint* const row = labels + (size_t)at * across;
    global const uint* const row_above = y > 0 ? row - across : row + slice - across;
    global const uint* const row_below = y + 1 < height ? row + across : row + across - slice;
    global const uint* const row_front = labels + (size_t)(z > 0 ? at - height : at + rows - height) * across;
    global const uint* const row_back = labels + (size_t)(z + 1 < depth ? at + height : y) * across;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const uint seed = positions[label];
      const int way_y = way_to(y, y_of(seed), height, PERIODIC_Y), way_z = way_to(z, z_of(seed), depth, PERIODIC_Z);
      const int place_y = y_of(seed) + way_y, place_z = z_of(seed) + way_z;
      const int beside = ALONG_Y(way_y) + ALONG_Z(way_z);
      const bool has_above = goes_on(y, -1, way_y, height, PERIODIC_Y);
      const bool has_below = goes_on(y, 1, way_y, height, PERIODIC_Y);
      const bool has_front = goes_on(z, -1, way_z, depth, PERIODIC_Z);
      const bool has_back = goes_on(z, 1, way_z, depth, PERIODIC_Z);
      global const uint* const above = has_above ? row_above : row;
      global const uint* const below = has_below ? row_below : row;
      global const uint* const front = has_front ? row_front : row;
      global const uint* const back = has_back ? row_back : row;
      global const uint* const away_y = way_y < 0 ? above : below;
      global const uint* const away_z = way_z < 0 ? front : back;
      const bool ends_y = way_y < 0 ? !has_above : !has_below, ends_z = way_z < 0 ? !has_front : !has_back;
      global int* const box = boxes + SIDES * (size_t)label;
      for (int from = walk.from, to; from < walk.to; from = to) {
        const int first_way = way_to(from, x_of(seed), width, PERIODIC_X);
        to = piece_end(from, walk.to, first_way, width, PERIODIC_X);
        const int first = from, last = to - 1, middle = (first + last) / 2, last_way = first_way + last - first;
        const int before = wrapped(first - 1, width, PERIODIC_X), behind = wrapped(last + 1, width, PERIODIC_X);
        if (!goes_on(first, -1, first_way, width, PERIODIC_X) ||
            !(row[before] == label || above[before] == label || below[before] == label || front[before] == label ||
              back[before] == label)) {
          atomic_min(box, x_of(seed) + first_way);
        }
        if (!goes_on(last, 1, last_way, width, PERIODIC_X) ||
            !(row[behind] == label || above[behind] == label || below[behind] == label || front[behind] == label ||
              back[behind] == label)) {
          atomic_max(box + 3, x_of(seed) + last_way);
        }
        if (!has_above || above[middle] != label) atomic_min(box + 1, place_y);
        if (!has_front || front[middle] != label) atomic_min(box + 2, place_z);
        if (!has_below || below[middle] != label) atomic_max(box + 4, place_y);
        if (!has_back || back[middle] != label) atomic_max(box + 5, place_z);
        if ((ends_y || away_y[first] != label) && (ends_z || away_z[first] != label)) {
          atomic_max(distances + label, beside + ALONG_X(first_way));
        }
        if ((ends_y || away_y[last] != label) && (ends_z || away_z[last] != label)) {
          atomic_max(distances + label, beside + ALONG_X(last_way));
        }
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
