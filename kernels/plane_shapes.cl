#include "plane.cl"
