"""The inputs of a test: the files that it used in one run under strace, and a digest of each.

Inputs are files of the repository, of its build folder and of ../shared. The digest of an opened file is that of its bytes; of a folder, of
the names in it; of a program that was only started, of its bytes without debug information, so that a comment that moves lines changes
nothing; of a path that was only searched for, whether it exists. Files that the test has written itself are no inputs. Neither are the
system's files, so a new version of Mesa starts no test again.
"""

import hashlib
import os
import pathlib
import re
import subprocess
import tempfile

SEEN, RAN, READ = 1, 2, 3  # how a test used a path: searched for, started, opened; the largest counts

FILES = "open,openat,openat2,execve,execveat,stat,lstat,newfstatat,statx,access,faccessat,faccessat2"
# The calls of a test whose result can depend on when it runs: another process or thread, a wait, a connection, a clock, memory in use.
TIMING = ("clone,clone3,fork,vfork,nanosleep,clock_nanosleep,poll,ppoll,select,pselect6,epoll_wait,epoll_pwait,epoll_pwait2,pause,"
          "rt_sigtimedwait,timerfd_create,timer_create,setitimer,alarm,socket,socketpair,flock,inotify_init,inotify_init1,"
          "clock_gettime,gettimeofday,time,times,getrusage")
STRACE = ["strace", "-f", "-y", "-qq", "--seccomp-bpf", "-e", f"trace={FILES},{TIMING}"]

CALL = re.compile(r"(\d+) +(\w+)\((.*)")
RESUMED = re.compile(r"(\d+) +<\.\.\. \w+ resumed>(.*)")
UNFINISHED = " <unfinished ...>"
PATH = re.compile(r'"((?:[^"\\]|\\.)*)"')
FOLDER = re.compile(r"(?:AT_FDCWD|\d+)<([^>]*)>")
RESULT = re.compile(r"\) += (-?\d+)(?:<([^>]*)>)?[^=]*$")

# A call of a clock, or of random numbers, in the disassembly of a program.
FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$")
CLOCK = re.compile(r"<(?:_ZNSt6chrono3_V2\d+\w+_clock3nowEv|_ZNSt13random_device\w+|clock|time|times|ftime|clock_gettime|gettimeofday"
                   r"|timespec_get|getrusage|g_get_(?:monotonic|real|current)_time|SDL_GetTicks\w*)[@$>]|\trdtscp?\b")


class Places:
    """The folders whose files are inputs."""

    def __init__(self, root, build, shared, git):
        self.root, self.build = (os.path.realpath(folder) for folder in (root, build))
        self._shared = os.path.realpath(shared)
        self._git = os.path.realpath(git)
        self._out = os.path.join(self.root, "out")

    def in_git(self, path):
        return is_in(path, self._git) or path == os.path.join(self.root, ".git") or is_in(path, os.path.join(self.root, ".git"))

    def counts(self, path):
        return (is_in(path, self.root) or is_in(path, self._shared)) and not is_in(path, self._out) and not self.in_git(path)

    def name(self, path):
        return os.path.relpath(path, self.root)

    def path(self, name):
        return os.path.normpath(os.path.join(self.root, name))


def is_in(path, folder):
    return path == folder or path.startswith(folder + "/")


def unescaped(text):
    return text.encode().decode("unicode_escape").encode("latin-1", "replace").decode(errors="replace") if "\\" in text else text


def calls(lines):
    """The calls of a trace as (process, name, the text after the bracket); a call that the trace splits into two lines is joined."""
    begun = {}
    for line in lines:
        line = line.rstrip("\n")
        if resumed := RESUMED.match(line):
            process, rest = resumed.groups()
            if process in begun:
                name, text = begun.pop(process)
                yield process, name, text + rest
        elif call := CALL.match(line):
            process, name, text = call.groups()
            if text.endswith(UNFINISHED):
                begun[process] = name, text[:-len(UNFINISHED)]
            else:
                yield process, name, text
    for process, (name, text) in begun.items():
        yield process, name, text  # the process ended within the call


class Trace:
    """`used`: path -> SEEN, RAN or READ. `asks_git`: the test asked git about the repository. `program`: the first program that was
    started. `timing`: the first call whose result can depend on when the test runs, or None."""

    def __init__(self, lines, places):
        self.used, self.asks_git, self.program, self.timing = {}, False, None, None
        self._places = places
        self._written = set()
        self._relative = {}  # process -> paths whose folder is not known yet
        for process, name, text in calls(lines):
            self._note_timing(name, text)
            if name in FILES.split(","):
                self._note_file(process, name, text)
        for path in self._written:
            self.used.pop(path, None)

    def _note_timing(self, name, text):
        if name == "execve" and self.program is None:
            self.program = unescaped(PATH.search(text)[1])
        elif name in TIMING.split(",") or name.startswith("execve") or re.search(r'"/(?:proc|sys)/', text):
            self.timing = self.timing or name

    def _note_file(self, process, name, text):
        folder, path, result = FOLDER.match(text), PATH.search(text), RESULT.search(text)
        if path is None or not path[1]:
            return
        path = unescaped(path[1])
        if folder:
            for early, way in self._relative.pop(process, []):
                self._use(os.path.join(unescaped(folder[1]), early), way)
            path = os.path.join(unescaped(folder[1]), path)
        way = SEEN
        if name.startswith("execve"):
            way = RAN if result and result[1] == "0" else SEEN
        elif name.startswith("open"):
            if re.search(r"O_WRONLY|O_RDWR|O_CREAT|O_TRUNC", text):
                self._written.add(os.path.normpath(path))
                return
            if result and result[2] and "O_PATH" not in text:
                path, way = unescaped(result[2]), READ
        if os.path.isabs(path):
            self._use(path, way)
        else:
            # Almost only execve is traced without its folder; the loader's first call after it names the folder.
            self._relative.setdefault(process, []).append((path, way))

    def _use(self, path, way):
        path = os.path.normpath(path)
        if "/__pycache__" in path:  # made by Python from the source, which Python then only stats
            folder, _, name = path.partition("/__pycache__")
            if way != READ or not name.endswith(".pyc"):
                return
            path = f"{folder}/{name[1:].split('.')[0]}.py"
        self.asks_git = self.asks_git or self._places.in_git(path)
        if self._places.counts(path):
            self.used[path] = max(way, self.used.get(path, SEEN))


def only_computes(trace, places):
    """Whether the test is a program of the build folder with one process and one thread, without a wait, and without reads of a clock."""
    return trace.timing is None and trace.program is not None and is_in(trace.program, places.build) and not reads_clock(trace.program)


def reads_clock(program):
    """Whether a function of the program, except GoogleTest's, reads a clock, which strace does not see. Shared libraries are ignored."""
    with subprocess.Popen(["objdump", "--disassemble", "--no-show-raw-insn", program], stdout=subprocess.PIPE, text=True) as disassembly:
        function, found = "", False
        for line in disassembly.stdout:
            if begin := FUNCTION.match(line):
                function = begin[1]
            elif not found and CLOCK.search(line):
                found = not function.endswith(("@plt", "$plt")) and not re.match(r"_ZNK?7testing", function)
    if disassembly.returncode:
        raise RuntimeError(f"objdump cannot read {program}")
    return found


class Digests:
    """The present digests of paths; each path is read once."""

    def __init__(self, places):
        self._places = places
        self._known = {}

    def of(self, name, way):
        if (name, way) not in self._known:
            self._known[name, way] = digest(self._places.path(name), way)
        return self._known[name, way]

    def of_all(self, ways):
        """`ways`: name -> SEEN, RAN or READ. Result: name -> [way, digest]."""
        return {name: [way, self.of(name, way)] for name, way in sorted(ways.items())}

    def changed(self, files):
        """The name of the first of `files`, a result of of_all(), whose digest has changed; None if none has."""
        return next((name for name, (way, then) in files.items() if self.of(name, way) != then), None)


def digest(path, way):
    if os.path.isdir(path):
        names = sorted(name for name in os.listdir(path) if name != "__pycache__") if way == READ else []
        return "folder " + short_hash("\n".join(names).encode()) if names else "folder"
    if not os.path.exists(path):
        return "missing"
    if way == SEEN:
        return "there"
    content = pathlib.Path(path).read_bytes()
    return short_hash(without_debug_information(path) if way == RAN and content.startswith(b"\x7fELF") else content)


def without_debug_information(program):
    """The program's bytes without debug information, and without the linker's build id, which is a hash of everything else."""
    with tempfile.NamedTemporaryFile() as file:
        subprocess.run(["objcopy", "--strip-debug", "--remove-section=.note.gnu.build-id", program, file.name], check=True)
        return pathlib.Path(file.name).read_bytes()


def short_hash(content):
    return hashlib.sha256(content).hexdigest()[:16]
