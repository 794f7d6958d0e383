#!/usr/bin/env bash
# Runs one command with a Slurm cluster of one node: munged, slurmctld and slurmd of Debian's slurm-wlm, in a folder, a network and a
# process tree of their own. The cluster ends with the command.
#
#   slurm_cluster.sh FOLDER COMMAND...     FOLDER is empty; needs root. The command has SLURM_CONF in its environment.
set -euo pipefail

if [[ ${1-} != --inside ]]; then
    exec unshare --net --mount --pid --fork --kill-child --mount-proc -- "$0" --inside "$@"
fi
folder=$(realpath "$2")
shift 2

# Slurm needs an address outside 127.0.0.0/8; lo gets one, as `ip address add` would do it.
address=10.9.8.7
python3 - "$address" <<'PYTHON'
import fcntl
import socket
import struct
import sys

SIOCGIFFLAGS, SIOCSIFFLAGS, SIOCSIFADDR, IFF_UP = 0x8913, 0x8914, 0x8916, 1
with socket.socket() as any_socket:
    flags = struct.unpack("16xh", fcntl.ioctl(any_socket, SIOCGIFFLAGS, struct.pack("16sh", b"lo", 0)))[0]
    fcntl.ioctl(any_socket, SIOCSIFFLAGS, struct.pack("16sh", b"lo", flags | IFF_UP))
    address = struct.pack("HH4s8x", socket.AF_INET, 0, socket.inet_aton(sys.argv[1]))
    fcntl.ioctl(any_socket, SIOCSIFADDR, struct.pack("16s16s", b"lo:1", address))
PYTHON

mkdir "$folder"/{state,spool,munge}
chmod 0755 "$folder" "$folder/munge"
head -c 128 /dev/urandom >"$folder/munge/key"
chmod 0400 "$folder/munge/key"
export SLURM_CONF=$folder/slurm.conf
node=$(hostname -s)
cat >"$SLURM_CONF" <<CONF
ClusterName=trial
SlurmctldHost=$node($address)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=$node NodeAddr=$address CPUs=$(nproc) RealMemory=$(awk '/^MemTotal/ { print int($2 / 1100) }' /proc/meminfo) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
munged --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed"
slurmctld
slurmd
while ((SECONDS < 60)); do # until the node has reported itself
    if [[ $(timeout 5 sinfo --noheader --format=%t 2>/dev/null) == idle ]]; then
        "$@"
        exit
    fi
    sleep 0.1
done
echo "slurm_cluster.sh: the node did not come up:" >&2
tail -n 5 "$folder/slurmctld.log" "$folder/slurmd.log" >&2
exit 1
