"""The words of a command line: those of the files that it names as @FILE, and those of the task behind --."""

import re
import shlex
from pathlib import Path

from .errors import bad_usage


class Word(str):
    """A word that stands in a file. where: FILE:LINE."""

    where: str

    def __new__(cls, text: str, where: str):
        word = super().__new__(cls, text)
        word.where = where
        return word

    def __getnewargs__(self):
        return str(self), self.where


def typed(option: str, text: str) -> str:
    """How errors name what stands behind an option: with the file and the line that it stands in."""
    return f"{f'{text.where}: ' if isinstance(text, Word) else ''}{option} {text}"


def apart(words: list[str]) -> tuple[list[str], list[str]]:
    """Our own words, with those of files, and the task's, which stand behind --."""
    at = words.index("--") if "--" in words else len(words)
    return read(words[:at]), words[at + 1 :]


def read(words: list[str]) -> list[str]:
    """Words of a line with those of the files that it names. A word behind --seeds is no option though it begins
    with -."""
    found: list[str] = []
    for word in words:
        found += _of_file(Path(word[1:]), word, ()) if word.startswith("@") else [word]
    for k in range(len(found) - 1, 0, -1):
        if found[k - 1] == "--seeds" and re.match(r"-\d", found[k]):
            found[k - 1 : k + 1] = [f"--seeds={found[k]}"]
    return found


def _of_file(file: Path, word: str, inside: tuple[Path, ...], at: str = "") -> list[str]:
    try:
        data = file.read_bytes()
        path = file.resolve()
    except (OSError, ValueError, RuntimeError) as failed:
        raise bad_usage(f"{at}{word} cannot be read: {failed}") from None
    if path in inside:
        raise bad_usage(f"{at}{word} contains itself")
    found = []
    for number, line in enumerate(data.split(b"\n"), 1):
        where = f"{file}:{number}"
        for text in _words_of(line, where):
            if text == "--":
                raise bad_usage(f"{where}: -- and options of the task stand on the line, not in a file")
            more = _of_file(Path(text[1:]), text, (*inside, path), f"{where}: ") if text.startswith("@") else None
            found += [Word(text, where)] if more is None else more
    return found


def _words_of(line: bytes, where: str) -> list[str]:
    try:
        text = line.decode().rstrip("\r")
    except UnicodeDecodeError:
        text = "\0"
    if not text.replace("\t", " ").isprintable():
        raise bad_usage(f"{where}: this is no text")
    try:
        return shlex.split(text, comments=True)
    except ValueError:
        raise bad_usage(f"{where}: a quotation mark, or a backslash, has nothing that ends it") from None
