// Kernels that `verb` cells: what PARAMETERS they take besides the sites, and the call for each that has been cut. It
// has the `tree`, the `cell` and its `site`. Cells that had no room are queued, and the second of the `counters` says
// how many.

#ifndef VOROCL_EXACT_CELLS_EACH_CELL
#define VOROCL_EXACT_CELLS_EACH_CELL

#define QUEUE_PARAMETERS global uint *counters, global uint *queue
#define CUT_CELL(call)                      \
  cut_by_all(&cell, &tree, &near, site);    \
  if (cell.is_full)                         \
    queue[atomic_inc(counters + 1)] = site; \
  else                                      \
    call;

#ifdef LARGE_CELLS
static inline void place_cell(cell_t* cell, global uchar* memory, int room) {
  cell->room = room;
#define PLACED_LIST(type, name, length) \
  cell->name = (global type*)memory;    \
  memory += (size_t)(length) * sizeof(type);
  CELL_LISTS(PLACED_LIST)
}

// The cells that had no room in private memory, from a list, each in so many bytes of global memory.
#define CELL_KERNEL(verb, PARAMETERS)                                                                                 \
  kernel __attribute__((vec_type_hint(CELL_VECTOR))) void verb##_large_cells(                                         \
      SITE_PARAMETERS, PARAMETERS, QUEUE_PARAMETERS, global const uint* restrict large, uint from, uint to,           \
      global uchar* restrict memory, int room)
#define EACH_CELL(call)                                                   \
  const uint i = (uint)get_global_id(0);                                  \
  if (i >= to - from) return;                                             \
  const tree_t tree = SITE_ARGUMENTS;                                     \
  const uint site = large[from + i];                                      \
  near_t near;                                                            \
  find_near(&near, &tree, site >> FAN_BITS);                              \
  cell_t cell;                                                            \
  place_cell(&cell, memory + (size_t)i * CELL_BYTES((size_t)room), room); \
  CUT_CELL(call)
#else
// A work-item cuts the cells of so many sites of a leaf: all of them one after the other, in the same memory,
// with one search of the leaves around; or one, where a device needs many items.
#define CELL_KERNEL(verb, PARAMETERS)                                   \
  kernel __attribute__((vec_type_hint(CELL_VECTOR))) void verb##_cells( \
      SITE_PARAMETERS, PARAMETERS, QUEUE_PARAMETERS, uint of_item)
#define EACH_CELL(call)                                \
  const uint first = (uint)get_global_id(0) * of_item; \
  if (first >= count) return;                          \
  const tree_t tree = SITE_ARGUMENTS;                  \
  near_t near;                                         \
  find_near(&near, &tree, first >> FAN_BITS);          \
  cell_t cell;                                         \
  for (uint site = first; site < min(first + of_item, count); ++site) { CUT_CELL(call) }
#endif

#endif
