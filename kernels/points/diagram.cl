// The exact diagram of a volume's places: their index, and labels region by region.

#include "points/regions.cl"
