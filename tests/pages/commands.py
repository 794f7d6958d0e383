"""The commands that pages and help texts print.

A fenced block without a language has commands, one a line; any other block, such as a printout, names its language ("text"). A code span
in a paragraph is a command if it begins with one of our programs. It is a shortened command if it begins with a subcommand and an option,
or with an option.
"""

import dataclasses
import re
import shlex

FENCE = re.compile(r"^ *```(\w*)")
SPAN = re.compile(r"(?<!`)`([^`]+)`(?!`)")
OPTIONAL = re.compile(r" \[([^][]*)\]")
PROGRAM = re.compile(r"(\./|\.ci/|image_build/|cmake/build\.sh|build/release/|ctest )|frustumscreen(-[a-z]+)? ")
ENDS = set(";&|()<>")


@dataclasses.dataclass(frozen=True)
class Command:
    page: str
    line: int
    text: str  # one line, without comment
    inline: bool = False

    @property
    def place(self):
        return f"{self.page}:{self.line}"

    @property
    def required(self):
        """Without the parts in brackets, which a reader may leave out."""
        return OPTIONAL.sub("", self.text)

    def simple_commands(self):
        """The words of each command of the line, also those in brackets."""
        text = OPTIONAL.sub(lambda part: " " + part[1].replace("|", " "), self.text)
        lexer = shlex.shlex(text, posix=True, punctuation_chars=True)
        lexer.whitespace_split = True
        lexer.commenters = ""
        commands, target = [[]], False
        for word in lexer:
            if set(word) <= ENDS:
                target = set(word) <= set("<>")  # the next word is a file
                if not target:
                    commands.append([])
            elif target:
                target = False
            else:
                commands[-1].append(word)
        return [words for words in map(without_prefix, commands) if words]


def without_prefix(words):
    """The words without those before the program: sudo, settings of variables."""
    while words and (words[0] in ("sudo", "export") or re.match(r"\w+=", words[0])):
        words = words[1:]
    return words


def without_comment(line):
    quote = ""
    for at, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter == "#" and (at == 0 or line[at - 1] in " \t"):
            return line[:at].rstrip()
    return line.rstrip()


def joined(lines):
    """(number of its first line, text) of each command; a line that ends with a backslash continues in the next."""
    begun, text = 0, ""
    for number, line in lines:
        line = without_comment(line.strip())
        line = re.sub(r"^\$ ", "", line)
        begun, text = (begun, text + " " + line) if text else (number, line)
        if text.endswith("\\"):
            text = text[:-1].rstrip()
        else:
            if text:
                yield begun, text
            text = ""


def parts_of(page):
    """The blocks of commands of a page, each as [(number, line)], and the whole text with all blocks blanked."""
    blocks, rest, language = [], [], None
    for number, line in enumerate(page.splitlines(), 1):
        fence = FENCE.match(line)
        if fence:
            if language is None:
                language = fence[1]
                if not language:
                    blocks.append([])
            else:
                language = None
        elif language == "":
            blocks[-1].append((number, line))
        rest.append("" if fence or language is not None else line)
    return blocks, "\n".join(rest)


def commands_of(name, page, subcommands=()):
    """All commands of a page, blocks first. `subcommands`: those of our programs, for code spans without the program's name."""
    blocks, rest = parts_of(page)
    found = [Command(name, number, text) for block in blocks for number, text in joined(block)]
    for span in SPAN.finditer(rest):
        text = " ".join(span[1].replace("\\|", " " if span[1].startswith("--") else "|").split())
        short = re.match(r"([a-z]+) --?[a-z]|(--)[a-z]", text)
        if "\n\n" not in span[1] and (PROGRAM.match(text) and " " in text or short and (short[2] or short[1] in subcommands)):
            found.append(Command(name, rest.count("\n", 0, span.start()) + 1, text, inline=True))
    return found


def examples_of(name, help_text):
    """The commands below the heading "examples:" of a --help."""
    section = re.search(r"^examples?:\n((?:[ \t]+.*\n?)+)", help_text, re.MULTILINE | re.IGNORECASE)
    lines = enumerate(section[1].splitlines(), help_text.count("\n", 0, section.start(1)) + 1) if section else ()
    return [Command(name, number, text) for number, text in joined(lines)]
