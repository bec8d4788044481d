// The program of exact diagrams of points in the vector shape.

#include "exact/points/tiles.cl"
