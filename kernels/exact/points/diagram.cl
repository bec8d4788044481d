// The program of exact diagrams of points.

#include "exact/points/tiles.cl"
