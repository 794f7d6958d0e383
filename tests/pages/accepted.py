"""The options and arguments that our programs accept, read from their --help."""

import dataclasses
import functools
import re
import subprocess

OPTION = re.compile(r"(?<![\w-])--?[A-Za-z][\w-]*")
# Words after which a program's --help describes another mode.
MODES = {
    "frustumscreen-bake": ("--watch", "--batch", "--check", "--words", "--prop-file"),
    "test": ("hil", "soak", "image --cuts", "image --start-time", "image"),
}
GUARD_S = 3600  # a limit only for a program that never ends


@dataclasses.dataclass(frozen=True)
class Accepted:
    options: frozenset
    choices: dict  # option -> its values, if it has a fixed few
    subcommands: frozenset
    required: tuple  # required options, each a tuple of its names
    operands: int  # number of required ones


@functools.lru_cache(maxsize=None)
def help_of(program, words=()):
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True, timeout=GUARD_S, check=False, stdin=subprocess.DEVNULL)
    if done.returncode != 0 or not done.stdout:
        raise ValueError(f"'{' '.join((program.name, *words))} --help' ends with {done.returncode}: {done.stderr.strip()[:200]}")
    return done.stdout


@functools.lru_cache(maxsize=None)
def read(program, words=()):
    text = help_of(program, words)
    options, choices, required = set(), {}, []
    for line in text.splitlines():
        head = re.match(r"\s+((?:--?[A-Za-z][\w-]*(?:, ?)?)+)(.*)", line)
        if not head:
            continue
        names = OPTION.findall(head[1])
        options.update(names)
        few = re.match(r" \S+:\{([^}]*)\}", head[2])
        choices.update({name: few[1].split(",") for name in names if few})
        if re.search(r" REQUIRED(?:  |$)", head[2]):
            required.append(tuple(names))
    usage = re.search(r"^usage: .*(?:\n .*)*", text, re.MULTILINE | re.IGNORECASE)
    options.update(OPTION.findall(usage[0]) if usage else ())
    return Accepted(frozenset(options), choices, frozenset(subcommands(text)), tuple(required),
                    len(re.findall(r"^  [A-Z]+ TEXT(?: \.\.\.)? REQUIRED", text, re.MULTILINE)))


def subcommands(text):
    """The subcommands: CLI11's list below a heading, or the words between bars after the program's name."""
    section = re.search(r"^Subcommands:\n((?:  .*\n?)+)", text, re.MULTILINE)
    if section:
        return re.findall(r"^  ([a-z][\w-]*)", section[1], re.MULTILINE)
    bars = re.match(r"usage: \S+ \[?([a-z]+(?:[^\n]*\|[a-z]+)+)", text)
    return re.findall(r"(?:^|\|)([a-z]+)", bars[1]) if bars else []


def of_command(program, arguments):
    """The syntax of these arguments; a ValueError names an unknown subcommand."""
    base = read(program)
    line = " ".join(arguments)
    for mode in MODES.get(program.name, ()):
        if mode.startswith("--") and mode in arguments or line == mode or line.startswith(mode + " "):
            return read(program, tuple(mode.split()))
    if not base.subcommands or not arguments or arguments[0].startswith("-"):
        return base
    if arguments[0] not in base.subcommands:
        raise ValueError(f"{program.name} has no subcommand '{arguments[0]}'")
    return base if program.name in MODES else read(program, (arguments[0],))


def objections(program, arguments):
    """One sentence for each word that the program would not accept."""
    try:
        accepted = of_command(program, arguments)
    except ValueError as error:
        return [str(error)]
    wrong = []
    for before, word, following in zip(["", *arguments], arguments, [*arguments[1:], ""]):
        name, _, value = word.partition("=")
        if not OPTION.fullmatch(name) or before in accepted.choices: # "--up -z"
            continue
        if name not in accepted.options:
            wrong.append(f"{program.name} has no option {name} here")
        elif name in accepted.choices and (value or following) not in accepted.choices[name] and not (value or following).isupper():
            wrong.append(f"{program.name} takes for {name} one of {', '.join(accepted.choices[name])}, not '{value or following}'")
    return wrong


def is_complete(program, arguments):
    """Whether the arguments have all that the program requires, and at least one value; otherwise they only mention program or option."""
    accepted = of_command(program, arguments)
    values = [word for word in arguments if not word.startswith("-") and word not in read(program).subcommands]
    named = all(any(name in arguments for name in names) for names in accepted.required)
    return named and len(values) >= max(1, len(accepted.required) + accepted.operands)
