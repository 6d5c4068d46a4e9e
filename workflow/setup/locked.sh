#!/bin/sh
# Run a command while holding this folder's lock; a second run refuses in one line. The kernel frees the lock when the
# command ends, however it ends, so that a killed run leaves nothing behind that stops the next one.
# Snakemake's own lock, which outlives a killed run, then gives way; without `flock` it stays in force.
# Usage: locked.sh SNAKEMAKE ARGUMENTS...
set -eu
mkdir -p .make
if command -v flock >/dev/null 2>&1; then
    exec 9>>.make/lock
    if ! flock --nonblock 9; then
        echo "another run is at work in $(pwd): wait for its end, or use another folder" >&2
        exit 2
    fi
    snakemake=$1
    shift
    exec "$snakemake" --nolock "$@"
fi
exec "$@"
