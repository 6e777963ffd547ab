# shellcheck shell=bash
# SPDX-License-Identifier: BSD-3-Clause
# A Slurm of its own with two nodes on this machine, for tests: source it, then `start_slurm`. Sets `work`, a folder that is
# removed at the end with all daemons; exits with 77 where Slurm or root is missing.

PATH=$PATH:/usr/sbin:/sbin  # of the daemons
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
