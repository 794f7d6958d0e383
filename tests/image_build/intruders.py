"""Detects break-ins: reads facts from the kernel of the running machine, and gives a sentence for each wrong one.

Frame    `facts` asks the test's agent; `wrong` compares the present facts with earlier ones and with the allowed ones.
         The agent's own processes do not count.
Threads  one caller.
Errors   MachineError.
"""

import re

# Processes that run all the time, and those that run for a short time: of the services' scripts, of sticks and of udev's rules.
STAYS = {"systemd", "systemd-journald", "udevadm", "frustumscreen", "frustumscreen-watchdog", "qemu-ga"}
COMES = {"frustumscreen-import", "systemd-mount", "systemd-executor", "systemctl", "journalctl", "mount", "ntfs-3g", "kmod", "lsblk",
         "dash", "sleep", "cat", "grep", "cut", "sed", "readlink", "basename", "dirname", "stat", "systemd-repart", "systemd-growfs",
         "rauc", "dbus-daemon"}
LISTENS = r"/run/(systemd|udev|frustumscreen[a-z-]*)/\S+"  # places of allowed UNIX sockets; no other program can create files there
KEPT = ("boot", "pid", "restarts", "net", "consoles", "tainted", "lockdown", "sysrq", "keyboards", "swaps", "volumes", "ports")
_SCRIPT = r"""
for p in /proc/[0-9]*; do
    exe=$(readlink $p/exe) && echo "process ${p#/proc/} $(sed -n 's/^PPid:[^0-9]*//p' $p/status) $exe"
done 2>/dev/null
echo "shown $(cat /sys/class/tty/tty0/active)"
echo "boot $(cat /proc/sys/kernel/random/boot_id)"
echo "pid $(systemctl show -P MainPID frustumscreen)"
echo "restarts $(systemctl show -P NRestarts frustumscreen)"
echo "tainted $(cat /proc/sys/kernel/tainted)"
echo "sysrq $(cat /proc/sys/kernel/sysrq)"
echo "lockdown $(cat /sys/kernel/security/lockdown)"
sed 's/^/consoles /' /proc/consoles
ls /sys/class/net | sed 's/^/net /'
ls /sys/class/tty | grep -e USB -e ACM | sed 's/^/ports /'
ls /sys/block | grep -v -e ^vd -e ^sd -e ^loop | sed 's/^/volumes /'
sed -n 1d\;'s/^/swaps /p' /proc/swaps
sed -n 's/^N: /keyboards /p' /proc/bus/input/devices
cd /proc/net
for f in tcp tcp6 udp udp6 udplite udplite6 raw raw6 icmp icmp6 packet vsock; do
    [ ! -e $f ] || sed -n 1d\;"s/^/socket $f /p" $f
done
sed -n 's/^[^ ]* [^ ]* [^ ]* 00010000 [^ ]* [^ ]* *[^ ]* */listens /p' unix
sed -n 's/^\([^ ]*\) \([^ ]*\) \([^ ]*\) \([^ ]*\) .*/mounted \2 \4/p' /proc/self/mounts
"""


def facts(machine):
    """The facts: kind -> lines, without the agent's own processes."""
    found = {"process": []}
    for line in machine.check(_SCRIPT, 120.0).splitlines():
        kind, _, what = line.partition(" ")
        found.setdefault(kind, []).append(what)
    found["process"] = _without_agent(found["process"])
    return found


def _without_agent(processes):
    rows = [line.split(" ", 2) for line in processes]
    mine = {pid for pid, _, exe in rows if exe.endswith("/qemu-ga")}
    while more := {pid for pid, parent, _ in rows if parent in mine} - mine:
        mine |= more
    return [exe for pid, _, exe in rows if pid not in mine]


def wrong(before, now, mounted=r"(?!)"):
    """A sentence for each sign of a break-in. `mounted`: a pattern of places that may have been mounted since `before`."""
    said = []
    for exe in now["process"]:
        folder, _, name = exe.rpartition("/")
        if not re.fullmatch(r"/usr/(bin|sbin|lib/systemd|lib/frustumscreen)", folder) or name not in STAYS | COMES:
            said.append(f"{exe} runs, which the image has no reason to run")
    said += [f"{name} runs no more" for name in ("systemd", "frustumscreen", "frustumscreen-watchdog")
             if not any(exe.endswith(f"/{name}") for exe in now["process"])]
    if now["shown"] != ["tty1"]:
        said.append(f"the console shows {now['shown']}, not tty1")
    said += [f"{kind} was {before.get(kind)} and is {now.get(kind)}" for kind in KEPT if before.get(kind) != now.get(kind)]
    said += [f"there is a network interface {name}" for name in now.get("net", []) if name != "lo"]
    said += [f"somebody may be spoken to: {line}" for line in now.get("socket", [])]
    said += [f"somebody listens at {path}" for path in now.get("listens", []) if not re.fullmatch(LISTENS, path)]
    if now["sysrq"] != ["0"] or "[integrity]" not in now["lockdown"][0]:
        said.append(f"the kernel obeys: SysRq {now['sysrq']}, lockdown {now['lockdown']}")
    for line in sorted(set(now["mounted"]) - set(before["mounted"])):
        place, _, options = line.partition(" ")
        if not re.fullmatch(mounted, place) or not {"ro", "nosuid", "nodev", "noexec"} <= set(options.split(",")):
            said.append(f"{place} is mounted, with {options}")
    return said
