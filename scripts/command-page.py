#!/usr/bin/python3
"""Turns what a program says of itself into a page: command-page.py man|markdown PROGRAM > PAGE"""
import html
import os
import re
import subprocess
import sys

EXIT_STATUS = [
    ("0", "done"),
    ("1", "options that are wrong; nothing has been done"),
    ("2", "an input that cannot be read, an output that cannot be written, no memory"),
    ("3", "a bound that was given is missed"),
]


INDENT = " " * 30  # of what --help says of an option


class Help:
    """`--help`, taken apart: purpose, usage, example, and (name, text) of arguments and options."""

    def __init__(self, program):
        def ask(option):
            return subprocess.run([program, option], check=True, capture_output=True, text=True).stdout

        self.name = os.path.basename(program)
        self.version = ask("--version").split()[-1]
        head, _, rest = ask("--help").partition("\nUsage: ")
        self.purpose = " ".join(head.split())
        self.usage = rest.splitlines()[0]
        self.example = rest.partition("\nExample:\n")[2].strip()
        self.entries = {"Positionals": [], "Options": []}
        section = None
        lines = rest.partition("\nExample:\n")[0].splitlines()[1:]
        for line, after in zip(lines, lines[1:] + [""]):
            if line.rstrip(":") in self.entries:
                section = self.entries[line.rstrip(":")]
            elif line.startswith(INDENT):
                section[-1][1].append(line.strip())
            elif line.strip():
                name, text = line.strip(), ""
                if two := re.match(r"(\S.*?)\s{2,}(.*)", name):
                    name, text = two.groups()
                elif not after.startswith(INDENT):
                    name, text = line[: len(INDENT)].strip(), line[len(INDENT) :]
                section.append((named(name), [text] if text else []))


def named(option):
    """CLI11's "--size INT:INT in [1 - 1024]=64" as "--size N (1 to 1024) [64]"."""
    if not option.startswith("-"):
        return option.split()[0]
    option = re.sub(r":(POSITIVE|NONNEGATIVE)| \.\.\.", "", option)
    option = re.sub(r"(INT|FLOAT):\1 in \[(\S+) - (\S+)\]", r"\1 (\2 to \3)", option)
    option = re.sub(r"=\[?([^\s\]]+)\]?", r" [\1]", option)
    option = re.sub(r"\w+:\{([^}]*)\}", lambda choices: choices[1].replace(",", "|"), option)
    for told, meant in ((",-", ", -"), ("UINT", "N"), ("INT", "N"), ("FLOAT", "X"), ("REQUIRED", "(required)"),
                        ("Needs:", "with")):
        option = option.replace(told, meant)
    return option


def man(page):
    def safe(text):
        return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", "\\e").replace("-", "\\-"))

    lines = [f'.TH {page.name.upper()} 1 "" "Weft {page.version}" "Weft"', ".SH NAME",
             f"{safe(page.name)} \\- {safe(page.purpose)}", ".SH SYNOPSIS", safe(page.usage)]
    for title, section in (("ARGUMENTS", "Positionals"), ("OPTIONS", "Options")):
        if page.entries[section]:
            lines.append(f".SH {title}")
        for name, text in page.entries[section]:
            lines += [".TP", f"\\fB{safe(name)}\\fR", "\n.br\n".join(map(safe, text)) or "\\&"]
    lines += [".SH EXIT STATUS"]
    for code, meaning in EXIT_STATUS:
        lines += [".TP", f"\\fB{code}\\fR", meaning]
    return "\n".join(lines + [".SH EXAMPLE", ".nf", safe(page.example), ".fi"]) + "\n"


def markdown(page):
    def safe(text):
        return text.replace("*", "\\*").replace("<", "&lt;").replace("|", "\\|").replace("_", "\\_")

    lines = [f"# {page.name}", "", safe(page.purpose), "", f"    {page.usage}", "", f"    {page.example}"]
    for title, section in (("argument", "Positionals"), ("option", "Options")):
        if page.entries[section]:
            lines += ["", f"| {title} | |", "| --- | --- |"]
        for name, text in page.entries[section]:
            name = html.escape(name).replace("|", "&#124;")
            lines.append(f"| <code>{name}</code> | {'<br>'.join(map(safe, text))} |")
    lines += ["", "| exit code | |", "| --- | --- |"]
    lines += [f"| {code} | {meaning} |" for code, meaning in EXIT_STATUS]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("man", "markdown"):
        sys.exit(__doc__)
    sys.stdout.write({"man": man, "markdown": markdown}[sys.argv[1]](Help(sys.argv[2])))
