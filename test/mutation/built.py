"""What a build knows: how each object is compiled and each test program is linked. Mutants are compiled and linked with
the same commands into a folder of their own: neither the sources nor the build are touched."""

from __future__ import annotations

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess

COMPILE_LIMIT = 300  # [s]


class Built:
    """A build folder that CMake has made for Ninja, with the tests built."""

    def __init__(self, folder: pathlib.Path):
        self.folder = folder
        commands = json.loads((folder / "compile_commands.json").read_text())
        self.compile = {}  # object -> arguments
        self.source = {}  # object -> file
        for c in commands:
            arguments = shlex.split(c["command"])
            output = arguments[arguments.index("-o") + 1]
            self.compile[output] = arguments
            self.source[output] = pathlib.Path(c["file"])
        self._links: dict[str, list[str]] = {}
        self._users: dict[str, list[str]] | None = None
        self.linker = ["-fuse-ld=gold"] if shutil.which("ld.gold") else []

    def has(self, program: str) -> bool:
        return (self.folder / "bin" / program).exists()

    def link_of(self, program: str) -> list[str]:
        """The arguments that link a program."""
        if program not in self._links:
            out = self._ninja("-t", "commands", "-s", f"bin/{program}").strip().split("\n")[-1]
            self._links[program] = shlex.split(re.sub(r"^: && ", "", out).split(" && ")[0])
        return self._links[program]

    def objects_of(self, source: pathlib.Path) -> list[str]:
        """Objects that a source file, or everything that includes a header, is compiled to."""
        if source.suffix == ".cpp":
            return [o for o, file in self.source.items() if file == source]
        return self.users().get(str(source), [])

    def users(self) -> dict[str, list[str]]:
        """By header: the objects that depend on it."""
        if self._users is None:
            self._users = {}
            current = None
            for line in self._ninja("-t", "deps").split("\n"):
                if line.startswith("    "):
                    if current in self.compile:
                        path = (self.folder / line.strip()).resolve()
                        self._users.setdefault(str(path), []).append(current)
                else:
                    current = line.split(":")[0]
        return self._users

    def is_linked(self, obj: str, program: str) -> bool:
        """Whether a program contains an object, itself or by its library."""
        return obj in self.link_of(program) or library_of(obj) in self.link_of(program)

    def compile_to(self, obj: str, output: pathlib.Path, overlay: pathlib.Path, source: pathlib.Path | None = None) -> bool:
        """Compiles an object anew. @param overlay: folder whose files come before those of the same name in the sources
        @param source: instead of the object's own. @return whether it could be compiled"""
        arguments = self._arguments(obj, overlay, source)
        arguments[arguments.index("-o") + 1] = str(output)
        return _succeeds(arguments, self.folder)

    def accepts(self, obj: str, overlay: pathlib.Path, source: pathlib.Path | None = None) -> bool:
        """Whether compile_to() could compile an object. No code is made: it takes a third of the time or less."""
        arguments = self._arguments(obj, overlay, source)
        arguments[arguments.index("-o") + 1] = os.devnull
        return _succeeds([*arguments, "-fsyntax-only"], self.folder)

    def _arguments(self, obj: str, overlay: pathlib.Path, source: pathlib.Path | None) -> list[str]:
        arguments = list(self.compile[obj])
        if source:
            arguments[arguments.index("-c") + 1] = str(source)
        # What is not used any more in a mutant is no error of it; a function that ends without its value does not compile.
        arguments[1:1] = [f"-I{overlay}"]
        return [*arguments, "-Wno-error", "-Werror=return-type", "-frandom-seed=mutant"]

    def offers_the_same(self, obj: str, new: pathlib.Path) -> bool:
        """Whether a new object has all functions that others can call in the build's; else the library's member would be
        linked beside it, and nothing would be tried."""
        return _offered(self.folder / obj) <= _offered(new)

    def link_to(self, program: str, output: pathlib.Path, objects: dict[str, pathlib.Path]) -> bool:
        """Links a program. @param objects: replaced ones; members of libraries come before their libraries"""
        arguments = list(self.link_of(program))
        arguments[arguments.index("-o") + 1] = str(output)
        members = [str(new) for old, new in objects.items() if old not in arguments and self.is_linked(old, program)]
        arguments = [str(objects[a]) if a in objects else a for a in arguments]
        first = next((k for k, a in enumerate(arguments) if a.endswith(".a")), len(arguments))
        arguments[first:first] = members
        return _succeeds(arguments + self.linker, self.folder)

    def _ninja(self, *arguments: str) -> str:
        done = subprocess.run(["ninja", "-C", str(self.folder), *arguments], capture_output=True, text=True, check=True)
        return done.stdout


def library_of(obj: str) -> str:
    """The static library of an object, as CMake calls it."""
    return re.sub(r"^(?:(.*)/)?CMakeFiles/([^/]+)\.dir/.*", lambda m: f"{m[1]}/lib{m[2]}.a" if m[1] else f"lib{m[2]}.a", obj)


def _offered(obj: pathlib.Path) -> set[str]:
    """What an object defines for others, without what any object may have, such as templates."""
    done = subprocess.run(["nm", "--extern-only", "--defined-only", "--format=posix", str(obj)], capture_output=True, text=True,
                          check=True)
    fields = [line.split() for line in done.stdout.splitlines()]
    return {f[0] for f in fields if len(f) > 1 and f[1] in "TDBRC"}


def _succeeds(arguments: list[str], folder: pathlib.Path) -> bool:
    try:
        done = subprocess.run(arguments, cwd=folder, capture_output=True, timeout=COMPILE_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0
