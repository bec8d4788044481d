// The exact diagram of a volume: an index of the seeds, labels where seeds are dense, and by boxes elsewhere.

#include "volumes/dense.cl"
