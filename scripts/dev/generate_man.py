#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the manual pages and completion scripts that an installation contains, from the help of the built programs.

    generate_man.py --program build/release/bin/halfspace [--bench build/release/bin/halfspace-bench]
                    [--view build/release/bin/halfspace-view] [--compress] FOLDER

Writes FOLDER/man/man1/*.1, or *.1.gz with --compress, and the completions for bash, zsh and fish, in the subfolders of /usr/share in which
these shells look for them.
"""
import argparse
import gzip
import pathlib
import re
import subprocess


def output_of(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def escape(text):
    """Returns text with the characters that roff interprets escaped."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in text.split("\n"))


def sections(text):
    """Splits a help text: (description, usage, [(title, lines)])."""
    lines = text.rstrip("\n").split("\n")
    description, usage, parts = lines[0], "", []
    for line in lines[1:]:
        if line.startswith("Usage: "):
            usage = line.removeprefix("Usage: ")
            parts.append(("Arguments", []))
        elif re.fullmatch(r"[A-Z]\w*:", line):
            parts.append((line[:-1], []))
        elif parts:
            parts[-1][1].append(line)
    return description, usage, [(title, body) for title, body in parts if any(line.strip() for line in body)]


def entries(lines):
    """Yields (term, explanation) for lines such as "  --size WxH     Size in pixels". Other lines have no explanation."""
    for line in lines:
        if match := re.fullmatch(r"  (\S.*?)(?:  +(\S.*))?", line):
            yield match[1], match[2] or ""
        elif line.strip():
            yield line.strip(), ""


def option_group(title, text):
    """Returns a section of the output of --help-model or --help-output: sentences, and a list with indented lines."""
    lines = text.rstrip("\n").split("\n")
    return title, [" ".join(line for line in lines if not line.startswith("  "))] + [line for line in lines if line.startswith("  ")]


def page(name, help_text, version, see_also, groups=()):
    """Returns a page. groups: further sections of options."""
    description, usage, parts = sections(help_text)
    parts[2:2] = groups
    summary = re.sub(r"^\w+: (a )?", "", description)
    out = [f'.TH {name.upper()} 1 "" "Halfspace {version}" "User Commands"', ".SH NAME", f"{escape(name)} \\- {escape(summary)}",
           ".SH SYNOPSIS", f".B {escape(usage)}"]
    for title, lines in parts:
        out.append(f".SH {title.upper()}")
        if title == "Examples":
            out += [".nf", escape("\n".join(line.strip() for line in lines if line.strip())), ".fi"]
            continue
        for term, text in entries(lines):
            out += [".TP", f".B {escape(term)}", escape(text)] if text else [".PP", escape(term)]
    if see_also:
        out += [".SH SEE ALSO", ",\n".join(f".BR {escape(other)} (1)" for other in see_also)]
    return "\n".join(out) + "\n"


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def write_page(folder, compress, name, *contents):
    """Writes the page that page(name, *contents) returns. The time stamp is omitted, so that the same page gives the same file."""
    folder.mkdir(parents=True, exist_ok=True)
    text = page(name, *contents).encode()
    (folder / f"{name}.1{'.gz' if compress else ''}").write_bytes(gzip.compress(text, mtime=0) if compress else text)


def write_view_completions(folder, help_text, scenes):
    """Writes completions of the options of halfspace-view and of scenes; other arguments are files."""
    options = re.findall(r"^  (?:-\w,)?--([\w-]+)(?: [A-Z=]\S*)?(?:  +(.*))?$", help_text, re.M)
    words = " ".join([f"--{name}" for name, _ in options] + scenes)
    write(folder / "bash-completion" / "completions" / "halfspace-view", f"complete -o default -W '{words}' halfspace-view\n")
    fish = [f"complete -c halfspace-view -l {name} -d '{text}'" for name, text in options]
    fish.append(f"complete -c halfspace-view -a '{' '.join(scenes)}'")
    write(folder / "fish" / "vendor_completions.d" / "halfspace-view.fish", "\n".join(fish) + "\n")
    zsh = " ".join(f"'--{name}[{re.sub(r'[][]', '', text)}]'" for name, text in options)
    write(folder / "zsh" / "site-functions" / "_halfspace-view",
          f"#compdef halfspace-view\n_arguments {zsh} '*:scene:_files'\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--bench")
    parser.add_argument("--view")
    parser.add_argument("--compress", action="store_true")
    parser.add_argument("folder", type=pathlib.Path)
    args = parser.parse_args()

    def write_manual(*contents):
        write_page(args.folder / "man" / "man1", args.compress, *contents)

    version = output_of(args.program, "--version").split()[-1]
    commands = output_of(args.program, "completion", "words").split()
    names = [f"halfspace-{command}" for command in commands]
    write_manual("halfspace", output_of(args.program, "--help"), version, names)
    for command, name in zip(commands, names):
        groups = []
        if command in ("render", "explain"):
            groups.append(option_group("Options for model files", output_of(args.program, command, "--help-model")))
        if command == "render":
            groups.append(option_group("Options for what is written", output_of(args.program, command, "--help-output")))
        write_manual(name, output_of(args.program, command, "--help"), version, ["halfspace"], groups)
    if args.bench:
        write_manual("halfspace-bench", output_of(args.bench, "--help"), version, ["halfspace"])
    if args.view:
        view_help, model_help = output_of(args.view, "--help"), output_of(args.view, "--help-model")
        write_manual("halfspace-view", view_help, version, ["halfspace"], [option_group("Options for model files", model_help)])
        write_view_completions(args.folder, view_help + model_help, output_of(args.program, "list", "--names").split())

    write(args.folder / "bash-completion" / "completions" / "halfspace", output_of(args.program, "completion", "bash"))
    write(args.folder / "fish" / "vendor_completions.d" / "halfspace.fish", output_of(args.program, "completion", "fish"))
    # zsh loads the file when it completes the command for the first time. The last line handles that first request.
    zsh = output_of(args.program, "completion", "zsh")
    write(args.folder / "zsh" / "site-functions" / "_halfspace", f"#compdef halfspace\n{zsh}_bash_complete -F _halfspace\n")


if __name__ == "__main__":
    main()
