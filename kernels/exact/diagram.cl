// The program of exact diagrams of planes in the vector shape.

#include "exact/tiles.cl"
