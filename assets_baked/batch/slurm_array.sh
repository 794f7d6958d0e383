#!/usr/bin/env bash
# Bakes a collection on a cluster with Slurm, as a job array: each task bakes one share of the objects.
#
#   sbatch [--array=1-N] assets_baked/batch/slurm_array.sh OBJECTS PACKS [OPTION...]
#
# OBJECTS and PACKS are folders that every node sees. OPTIONs go to `frustumscreen-bake --batch`. A task that was ended or that
# had failures is simply submitted again, with the whole array: what is done costs no more than reading it.
# Afterwards one report of all:
#   frustumscreen-bake --batch OBJECTS -o PACKS [OPTION...] --report-only
#
#SBATCH --job-name=frustumscreen-batch
#SBATCH --array=1-20
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=2
#SBATCH --mem=4000M
#SBATCH --time=24:00:00
#SBATCH --output=frustumscreen-batch.%A.%a.log
set -euo pipefail

if (($# < 2)); then
    echo "usage: sbatch [--array=1-N] slurm_array.sh OBJECTS PACKS [OPTION...]" >&2
    exit 2
fi
if [[ ${SLURM_ARRAY_TASK_MIN-} != 1 || ${SLURM_ARRAY_TASK_STEP-} != 1 ||
    ${SLURM_ARRAY_TASK_COUNT-} != "$SLURM_ARRAY_TASK_MAX" ]]; then
    echo "slurm_array.sh: the shares would not fit together; submit the array as --array=1-N" >&2
    exit 2
fi
objects=$1
packs=$2
shift 2
limits=()
if [[ ${SLURM_MEM_PER_NODE:-0} != 0 ]]; then
    limits=(--memory-limit "$SLURM_MEM_PER_NODE") # a bake that needs more fails alone
fi
exec "${FRUSTUMSCREEN_BAKE:-frustumscreen-bake}" --batch "$objects" -o "$packs" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" "${limits[@]}" "$@"
