"""An emulated PC: QEMU without KVM, its monitor (QMP) and the guest's agent.

Frame    one machine for a whole test run; every start begins with the same file systems.
Time     seconds that the host granted (`granted_s`), unless a comment says otherwise.
Threads  one caller.
Errors   MachineError, which names the folder of the serial log.
Source   QEMU Machine Protocol and Guest Agent protocol references, docs of QEMU 7.2.
"""

import base64
import json
import os
import pathlib
import shlex
import socket
import subprocess
import time
from dataclasses import dataclass, field

# An emulated processor without AVX. QEMU 7.2's gather of AVX2 (vpgatherdd) reads 2 GiB beside its base if a page fault interrupts it, and
# llvmpipe ends with SIGSEGV (README.md). Without AVX, llvmpipe also uses smaller vectors, which the emulator computes quickly.
# Tests on the host cover AVX2.
PROCESSOR = "max,avx=off,avx2=off,fma=off,f16c=off,vaes=off,vpclmulqdq=off"
SECOND_SLOT = 0x10  # of the second graphics card, on the PCI bus
START_S = 180.0  # until the agent answers; 13 to 30 s on two cores


class MachineError(Exception):
    pass


class JsonLines:
    """A socket on which one line is one JSON object."""

    def __init__(self, path, timeout_s):
        deadline = time.monotonic() + 60.0
        while True:
            self._socket = socket.socket(socket.AF_UNIX)
            try:
                self._socket.connect(str(path))
                break
            except OSError:
                self._socket.close()
                if time.monotonic() > deadline:
                    raise
                time.sleep(0.05)
        self._socket.settimeout(timeout_s)
        self._bytes = b""
        self._events = set()

    def close(self):
        self._socket.close()

    def send(self, message, lead=b""):
        self._socket.sendall(lead + json.dumps(message).encode() + b"\n")

    def receive(self):
        while b"\n" not in self._bytes:
            more = self._socket.recv(1 << 16)
            if not more:
                raise EOFError("the other side hung up")
            self._bytes += more
        line, self._bytes = self._bytes.split(b"\n", 1)
        return json.loads(line.lstrip(b"\xff"))

    def event_came(self, name):
        """True if this event came since the last call."""
        came = name in self._events
        self._events.discard(name)
        return came

    def answer(self, message):
        """Sends a command and returns its answer; notes events in between."""
        self.send(message)
        while True:
            answer = self.receive()
            self._events.add(answer.get("event"))
            if "return" in answer:
                return answer["return"]
            if "error" in answer:
                raise MachineError(f"{message['execute']}: {answer['error'].get('desc', answer['error'])}")


@dataclass
class Given:
    """Two clocks of the guest, which stop while a busy host makes the guest wait."""

    granted_s: float  # time in which neither its processors nor its mocked devices waited for one of the host's
    rested_s: float  # the part of it in which none of its processors had work

    def after(self, took_s, processors, devices):
        """The clocks after a further time. `processors`, `devices`: the seconds for which each ran, and for which it waited for one of the
        host's processors."""
        devices_s = max((waited for _, waited in devices), default=0.0)
        rested_s = min(took_s - ran - waited for ran, waited in processors) - devices_s
        return Given(self.granted_s + took_s - max(devices_s, *(waited for _, waited in processors)),
                     self.rested_s + max(0.0, rested_s))


@dataclass
class Ran:
    """The result of a command in the guest."""

    status: int
    output: str


@dataclass
class Machine:
    """`files`: folder with linux, initrd, cmdline; `disk`: the kiosk's; `sockets`: a folder with a short name (a socket's
    path has 107 bytes at most); `logs`: where serial.log and qemu.log go; `usb`: name -> socket of a usbredir device that
    listens there; `device_processes`: the numbers of the processes that mock them."""

    files: pathlib.Path
    disk: pathlib.Path
    sockets: pathlib.Path
    logs: pathlib.Path
    width: int
    height: int
    usb: dict = field(default_factory=dict)
    processor: str = PROCESSOR
    processors: int = 2
    memory_mib: int = 1536
    device_processes: tuple = ()
    _sticks: dict = field(default_factory=dict)

    def start(self):
        self.logs.mkdir(parents=True, exist_ok=True)
        with open(self.logs / "qemu.log", "w", encoding="utf-8") as log:
            # a new session, so that a person can keep the machine after the tests
            self._process = subprocess.Popen(self._command(), stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                             start_new_session=True)
        try:
            self.connect_monitor()
            self._connect_agent()
        except (OSError, EOFError, MachineError) as error:
            said = self.last_lines()
            self.stop()
            raise MachineError(f"the guest did not start ({error}); see {self.logs}; its last lines:\n{said}") from error

    def connect_monitor(self):
        """Connects to QEMU's monitor, which answers as soon as QEMU runs. The guest's clocks begin here."""
        self.pid = self._process.pid
        self._monitor = JsonLines(self.sockets / "monitor", 30.0)
        self._monitor.receive()
        self.monitor("qmp_capabilities")
        self._threads = [processor["thread-id"] for processor in self.monitor("query-cpus-fast")]
        self._given, self._asked = Given(0.0, 0.0), self._scheduled()

    def last_lines(self, count=40):
        """The end of the guest's output on its serial line. If a shell listens there, it is first asked for the agent's status."""
        try:
            with socket.socket(socket.AF_UNIX) as line:
                line.connect(os.fspath(self.sockets / "serial"))
                line.sendall(b"\nsystemctl --no-pager -n 5 status frustumscreen-test-agent; journalctl -b --no-pager -n 30 -o short-monotonic\n")
                time.sleep(15.0)
        except OSError:
            pass
        log = self.logs / "serial.log"
        said = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.exists() else []
        return "\n".join([line for line in said if line.strip()][-count:]) or "(it said nothing)"

    def _command(self):
        command = [
            "qemu-system-x86_64", "-name", "frustumscreen-hil", "-machine", "q35",
            "-accel", "tcg,thread=multi,tb-size=512", "-cpu", self.processor, "-smp", str(self.processors),
            "-m", f"{self.memory_mib}M", "-display", "none", "-no-user-config", "-nodefaults", "-no-reboot",
            "-kernel", self.files / "linux", "-initrd", self.files / "initrd",
            "-append", (self.files / "cmdline").read_text(encoding="utf-8"),
            # Writes are lost when QEMU ends, and kept when the machine reboots.
            "-drive", f"if=none,id=disk,format=raw,snapshot=on,file={self.disk}", "-device", "virtio-blk-pci,drive=disk,serial=disk",
            *self.lines(),
            "-vga", "none",
            "-device", f"bochs-display,id=screen,edid=on,xres={self.width},yres={self.height}",
            "-device", f"virtio-gpu-pci,id=second,edid=on,xres={self.width},yres={self.height},max_outputs=2,addr={SECOND_SLOT:#x}",
            "-vnc", f"unix:{self.sockets}/second,display=second",
            "-vnc", f"unix:{self.sockets}/second-1,display=second,head=1",
            "-audiodev", f"wav,id=heard,path={self.heard},out.frequency=48000,out.channels=2",
            "-device", "intel-hda", "-device", "hda-output,audiodev=heard",
            "-device", "qemu-xhci,id=usb,p2=12,p3=12",  # with fewer ports QEMU adds hubs, of the slowest kind
            "-device", "i6300esb", "-action", "watchdog=none",  # the hardware's watchdog; a test lets it act
        ]
        command += self.usb_devices()
        return [str(word) for word in command]

    def lines(self):
        """QEMU's monitor, the serial line and the guest's agent."""
        return [
            "-qmp", f"unix:{self.sockets}/monitor,server=on,wait=off",
            "-chardev", f"socket,id=serial,path={self.sockets}/serial,server=on,wait=off,logfile={self.logs}/serial.log",
            "-serial", "chardev:serial",
            "-device", "virtio-serial-pci",
            "-chardev", f"socket,id=agent,path={self.sockets}/agent,server=on,wait=off",
            "-device", "virtserialport,chardev=agent,name=org.qemu.guest_agent.0",
            "-device", "virtio-rng-pci",
        ]

    def usb_devices(self):
        return [word for name, path in self.usb.items() for word in (
            "-chardev", f"socket,id={name},path={path},reconnect=1", "-device", f"usb-redir,id=usb-{name},chardev={name}")]

    def may_start_anew(self):
        """Lets the hardware's watchdog, a panic or a reboot restart the machine; before this call they end it."""
        self.monitor("set-action", reboot="reset", watchdog="reset")
        self._monitor.event_came("RESET")

    def resets_within(self, timeout_s):
        """True if the machine is reset within this time, by its monitor's events."""
        deadline = self.granted_s() + timeout_s
        while True:
            self.monitor("query-status")
            if self._monitor.event_came("RESET"):
                return True
            if self.granted_s() >= deadline:
                return False
            time.sleep(0.5)

    def wait_for_start(self):
        """Waits, after a reset of the machine, until its agent answers again."""
        self._agent.close()
        self._connect_agent()

    def _connect_agent(self):
        """Connects to the agent, which answers once the guest's user space runs. Earlier messages may be lost, so they are repeated."""
        agent = JsonLines(self.sockets / "agent", 1.0)
        deadline = self.granted_s() + START_S
        token = int(time.monotonic() * 1000) & 0x7FFFFFFF
        while True:
            if self._process.poll() is not None:
                raise MachineError("QEMU ended")
            if self.granted_s() > deadline:
                raise MachineError(f"no answer within {START_S:.0f} s")
            token += 1
            try:
                agent.send({"execute": "guest-sync-delimited", "arguments": {"id": token}}, b"\xff")
                while agent.receive().get("return") != token:
                    pass
                break
            except (TimeoutError, ValueError):
                continue
        agent._socket.settimeout(60.0)
        self._agent = agent

    @property
    def heard(self):
        """The file of the sound card's output: 16-bit stereo at 48 kHz after a header of 44 bytes, whose sizes QEMU fills in when
        it ends."""
        return self.logs / "heard.wav"

    def monitor(self, command, **arguments):
        return self._monitor.answer({"execute": command, "arguments": arguments})

    def _scheduled(self):
        """The time now, and for each of the guest's processors, QEMU's main thread and each mocked device the seconds in which it ran, and those in which it
        was ready to run but the host's processors were busy (Linux, Documentation/scheduler/sched-stats.rst: /proc/PID/schedstat)."""
        files = [f"/proc/{self.pid}/task/{thread}/schedstat" for thread in self._threads]
        # QEMU's main thread serves the guest's timers and its USB ports, as the mocked devices do.
        files += [f"/proc/{process}/schedstat" for process in (self.pid, *self.device_processes)]
        words = [pathlib.Path(file).read_text(encoding="ascii").split() for file in files]
        return time.monotonic(), [(1e-9 * int(ran), 1e-9 * int(waited)) for ran, waited, _ in words]

    def given(self):
        """The time that the host has granted the guest so far; time in which a device waits for the host's processors is not granted either.
        Call it about every 50 ms. Less often, it cannot distinguish processors that wait one after another from processors that wait at the
        same time; more often, a wait counts as rest until it ends.
        """
        now, scheduled = self._scheduled()
        before, self._asked = self._asked, (now, scheduled)
        spent = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(before[1], scheduled)]
        count = len(self._threads)
        self._given = self._given.after(now - before[0], spent[:count], spent[count:])
        return self._given

    def granted_s(self):
        return self.given().granted_s

    def processor_s(self):
        """The host's processor seconds that QEMU has used; 0: it has ended."""
        try:
            words = pathlib.Path(f"/proc/{self.pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
        except OSError:
            return 0.0
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")

    def _rest(self, seconds):
        """Pauses for `seconds`, and reads the clock as often as `given` asks for."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            time.sleep(min(left, 0.05))
            self.granted_s()

    def let_run(self, seconds):
        """Waits until the host has granted the guest this many more seconds."""
        until = self.granted_s() + seconds
        while self.granted_s() < until:
            time.sleep(0.05)

    def spawn(self, command):
        """Starts a shell command in the guest and returns its process number."""
        arguments = {"path": "/bin/sh", "arg": ["-c", command], "capture-output": True}
        return self._agent.answer({"execute": "guest-exec", "arguments": arguments})["pid"]

    def run(self, command, timeout_s=60.0):
        """Runs a shell command in the guest as root."""
        pid = self.spawn(command)
        deadline = self.granted_s() + timeout_s
        pause_s = 0.01
        while True:
            state = self._agent.answer({"execute": "guest-exec-status", "arguments": {"pid": pid}})
            if state["exited"]:
                break
            if self.granted_s() > deadline:
                raise MachineError(f"in the guest, after {timeout_s:.0f} s still running: {command}")
            self._rest(pause_s)
            pause_s = min(2 * pause_s, 0.5)
        output = b"".join(base64.b64decode(state.get(key, "")) for key in ("out-data", "err-data"))
        return Ran(state.get("exitcode", -1), output.decode(errors="replace"))

    def check(self, command, timeout_s=60.0):
        """Like `run`, but a status other than 0 is an error; returns the output."""
        ran = self.run(command, timeout_s)
        if ran.status != 0:
            raise MachineError(f"in the guest: {command}: status {ran.status}: {ran.output.strip()}")
        return ran.output

    def read(self, path, last=None):
        """A small file of the guest, or its `last` bytes; None: it cannot be opened. Unlike `run`, it starts no process in the guest."""
        try:
            handle = self._agent.answer({"execute": "guest-file-open", "arguments": {"path": path}})
        except MachineError:
            return None
        if last is not None:
            try:
                self._agent.answer({"execute": "guest-file-seek", "arguments": {"handle": handle, "offset": -last, "whence": "end"}})
            except MachineError:
                pass  # the file is shorter
        found = self._agent.answer({"execute": "guest-file-read", "arguments": {"handle": handle, "count": 1 << 16}})
        self._agent.answer({"execute": "guest-file-close", "arguments": {"handle": handle}})
        return base64.b64decode(found["buf-b64"]).decode(errors="replace")

    def write(self, path, text):
        """Writes a small file in the guest; a concurrent reader gets the complete old one."""
        encoded, path = base64.b64encode(text.encode()).decode(), shlex.quote(path)
        self.check(f"echo {encoded} | base64 -d > {path}.new && mv {path}.new {path}")

    # Sticks at the USB ports.

    def plug(self, name, source, bytes_per_s=None, serial=None, driver="usb-storage", written_per_s=None, protected=False):
        """Puts a stick in. `source`: an image, or the socket of an NBD server; `driver`: usb-storage or usb-uas (USB attached SCSI), to
        which the disk is attached before the guest sees the device. `bytes_per_s`, `written_per_s`: upper limits of reading and writing;
        `protected`: its switch is set to write-protected."""
        source = pathlib.Path(source)
        if source.is_socket():
            disk = {"driver": "nbd", "server": {"type": "unix", "path": os.fspath(source)}}
        else:
            disk = {"driver": "file", "filename": os.fspath(source)}
        self.monitor("blockdev-add", **{"driver": "raw", "node-name": f"{name}-raw", "file": disk | {"read-only": protected},
                                        "read-only": protected})
        nodes = [f"{name}-raw"]
        limits = {key: limit for key, limit in (("bps-read", bytes_per_s), ("bps-write", written_per_s)) if limit is not None}
        if limits:
            self.monitor("object-add", **{"qom-type": "throttle-group", "id": f"{name}-pace", "limits": limits})
            self.monitor("blockdev-add", **{"driver": "throttle", "node-name": f"{name}-slow", "throttle-group": f"{name}-pace",
                                            "file": nodes[0]})
            nodes.insert(0, f"{name}-slow")
        disk = {"drive": nodes[0], "removable": True, "serial": serial or name}
        if driver == "usb-uas":
            self.monitor("device_add", driver=driver, id=name, bus="usb.0")
            self.monitor("device_add", driver="scsi-hd", id=f"{name}-disk", bus=f"{name}.0", **disk)
            self.monitor("qom-set", path=f"/machine/peripheral/{name}", property="attached", value=True)
        else:
            self.monitor("device_add", driver=driver, id=name, bus="usb.0", **disk)
        self._sticks[name] = nodes

    def slow_down(self, name, bytes_per_s):
        """Reduces the limit of reading of a stick that has one."""
        self.monitor("qom-set", path=f"/objects/{name}-pace", property="limits", value={"bps-read": bytes_per_s})

    def pull(self, name):
        """Pulls a stick out, even while the guest uses it."""
        self.monitor("device_del", id=name)
        for node in self._sticks.pop(name):
            deadline = time.monotonic() + 30.0
            while True:  # the device releases the node a little later
                try:
                    self.monitor("blockdev-del", **{"node-name": node})
                    break
                except MachineError:
                    if time.monotonic() > deadline:
                        raise
                    time.sleep(0.02)
            if node.endswith("-slow"):
                self.monitor("object-del", id=f"{name}-pace")

    def screendump(self, path, screen="screen", head=0):
        """Writes the present picture of a card's output to a PPM file on the host."""
        self.monitor("screendump", device=screen, head=head, filename=os.fspath(path))

    def stop(self):
        if self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(10.0)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
