#!/usr/bin/env bash
# A manifest as a job array of Slurm: each task runs its part of the rows.
#
#   sbatch --array=1-8 examples/batch/slurm.sh MANIFEST
#   sbatch --dependency=afterany:JOB --wrap 'heatpath batch MANIFEST --resume --report report.html'
#
# The second job gathers the logs of all parts. Tasks that are preempted, or run out of time, go on where
# they were when they are started again, with another number of tasks too.
#SBATCH --job-name=heatpath
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --output=heatpath-%A_%a.out
set -euo pipefail

manifest=${1:?the manifest is missing: sbatch --array=1-8 $0 MANIFEST}
part=${SLURM_ARRAY_TASK_ID:?not in a job array: sbatch --array=1-8 $0 MANIFEST}
parts=${SLURM_ARRAY_TASK_MAX:-$part}
jobs=${SLURM_CPUS_PER_TASK:-1}

exec "${HEATPATH:-heatpath}" batch "$manifest" --shard "$part/$parts" --retry-failed --jobs "$jobs"
