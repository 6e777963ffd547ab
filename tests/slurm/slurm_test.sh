#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# tools/slurm with a real slurmctld and two slurmd on this machine: a node is killed while it works, a task fails once,
# and the merged data set verifies and has the bytes of a single run. Arguments: program, source folder. Exit code 77: skipped.
set -euo pipefail
program=$(realpath "$1")
source=$(realpath "$2")

for needed in munged slurmctld slurmd sbatch; do
  command -v "$needed" >/dev/null || { echo "skipped: $needed is missing (packages slurm-wlm and munge)"; exit 77; }
done
[[ $(id -u) -eq 0 ]] || { echo "skipped: the daemons need root"; exit 77; }

work=$(mktemp -d -t seaglint_slurm_XXXXXX)
chmod 755 "$work"
daemons=()

# Processes of our jobs on a node, with the steps' daemons above them: their environment names node and this Slurm.
job_processes() {
  local file pid parent
  for file in $(grep -lzxF "SLURMD_NODENAME=$1" /proc/[0-9]*/environ 2>/dev/null); do
    grep -qzxF "SLURM_CONF=$work/slurm.conf" "$file" 2>/dev/null || continue
    pid=${file//[^0-9]/}
    echo "$pid"
    parent=$(awk '$1 == "PPid:" { print $2 }' "/proc/$pid/status" 2>/dev/null) || continue
    if [[ -n $parent ]] && grep -q '^slurmstepd' "/proc/$parent/cmdline" 2>/dev/null; then echo "$parent"; fi
  done
}

stop_everything() {
  local code=$? pid
  trap - EXIT
  if ((code != 0)); then
    tail -n 20 "$work"/{submit,slurm*}.log "$work"/data.slurm/*.log 2>/dev/null || true
  fi
  for pid in $(job_processes n1) $(job_processes n2) "${daemons[@]}"; do kill -9 "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
  exit "$code"
}
trap stop_everything EXIT
trap 'exit 1' INT TERM

fail() { echo "failed: $1"; exit 1; }

# until_true SECONDS COMMAND...: waits until the command succeeds.
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < end)) || fail "timed out: $*"
    sleep 0.2
  done
}

free_port() { /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'; }

start_slurm() {
  local host
  host=$(hostname -s)
  mkdir -m 755 "$work/munge"
  dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 status=none
  chmod 400 "$work/munge/key"
  chown -R munge "$work/munge"
  # The daemons end with this script, whatever its exit code.
  setpriv --pdeathsig=KILL --reuid=munge --regid=munge --clear-groups munged --foreground --force --socket="$work/munge/socket" \
    --key-file="$work/munge/key" --log-file="$work/munge/log" --pid-file="$work/munge/pid" \
    --seed-file="$work/munge/seed" >"$work/munged.log" 2>&1 &
  daemons+=($!)
  until_true 10 test -S "$work/munge/socket"
  cat >"$work/slurm.conf" <<END
ClusterName=seaglint
SlurmctldHost=$host
SlurmctldPort=$(free_port)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket,cred_expire=5
StateSaveLocation=$work/state
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd_%n.pid
SlurmdSpoolDir=$work/spool_%n
SlurmdParameters=config_overrides
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,batch_sched_delay=1,sched_min_interval=100000
SlurmdTimeout=6
SlurmctldTimeout=30
InactiveLimit=0
KillWait=2
ReturnToService=2
NodeName=n1 NodeHostname=$host Port=$(free_port) CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host Port=$(free_port) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
  export SLURM_CONF=$work/slurm.conf
  mkdir "$work/state" "$work/spool_n1" "$work/spool_n2"
  setpriv --pdeathsig=KILL slurmctld -D >"$work/slurmctld.log" 2>&1 &
  daemons+=($!)
  setpriv --pdeathsig=KILL slurmd -D -N n1 >"$work/slurmd_n1.log" 2>&1 &
  daemons+=($!)
  setpriv --pdeathsig=KILL slurmd -D -N n2 >"$work/slurmd_n2.log" 2>&1 &
  daemons+=($!)
  node_2=$!
  until_true 20 sh -c "sinfo --noheader --format=%T | grep -qx idle && ! sinfo --noheader --format=%T | grep -vqx idle"
}

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
