#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# tools/slurm with a real slurmctld and two slurmd on this machine: a node is killed while it works, a task fails once,
# and the merged data set verifies and has the bytes of a single run. Arguments: program, source folder. Exit code 77: skipped.
set -euo pipefail
program=$(realpath "$1")
source=$(realpath "$2")

source "$source/tests/slurm/cluster.sh"

running_on_node_2() { [[ -n $(job_processes n2) ]]; }

scenario=(scenarios/points.yaml --set dataset.maps_per_shard=4 --set dataset.maps_per_case=100)
cd "$source"

echo "== a single run"
"$program" generate "${scenario[@]}" -o "$work/single"

echo "== Slurm"
start_slurm
sinfo

# The program fails the first time that part 3 runs, as on a full local disk or a lost file system.
cat >"$work/program" <<END
#!/bin/bash
if [[ "\$*" == *"--part 3/6"* && ! -e $work/failed_once ]]; then touch $work/failed_once; exit 1; fi
exec "$program" "\$@"
END
chmod +x "$work/program"

setpriv --pdeathsig=KILL tools/slurm "${scenario[@]}" -o "$work/data" --parts 6 --retries 08 --program "$work/program" --wait >"$work/submit.log" 2>&1 &
waiting=$!
daemons+=("$waiting")
until_true 30 running_on_node_2
# Whoever may write beside the data set must not run commands in the jobs to come.
echo "touch $work/executed" >>"$work/data.slurm/run"
sleep 1
echo "== killing node n2 with the processes of its job"
squeue
victims=$(job_processes n2)
for pid in $victims; do echo "$pid $(tr '\0' ' ' <"/proc/$pid/cmdline")"; done
kill -9 "$node_2" $victims
wait "$waiting" || { cat "$work/submit.log"; fail "tools/slurm --wait"; }

echo "== output of tools/slurm"
cat "$work/submit.log"
echo "== output of Slurm"
grep -hE "requeue|not responding|Killing|DOWN" "$work/slurmctld.log" | head -n 8 || true
echo "== output of the last job"
cat "$work/data.slurm/finish.log"
[[ -e $work/failed_once ]] || fail "no task failed"
grep -hq "restart 1" "$work"/data.slurm/part-*.log || fail "no part was requeued after its node was killed"
[[ ! -e $work/executed ]] || fail "a file beside the data set was executed"
for shard in "$work"/single/*; do cmp "$shard" "$work/data/$(basename "$shard")" || fail "not as in the single run"; done
[[ $(ls "$work/data" | wc -l) -eq $(($(ls "$work/single" | wc -l) + 1)) ]] || fail "more files than the single run's and dataset.h5"
"$program" verify "$work/data"
echo "== equal to the single run, byte for byte"
