#!/usr/bin/env bash
# Runs a program on so many ranks, which may be more than there are cores, also as root: run_ranks.sh RANKS PROGRAM...
set -euo pipefail
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
# Ranks that wait must not keep the others from their cores.
export OMPI_MCA_mpi_yield_when_idle=1
ranks=$1
shift
exec mpiexec -n "$ranks" "$@"
