"""The bar: how many runs, how many of them failed, the rate, the time left."""

import sys

from tqdm import tqdm


class Progress:
    """Of a campaign, on standard error: a bar on a terminal, otherwise a line now and then."""

    def __init__(self, total: int, done: int, failed: int):
        alive = sys.stderr.isatty()
        self._failed = failed
        self._bar = tqdm(
            total=total, initial=done, unit="run", file=sys.stderr, dynamic_ncols=alive, mininterval=0.5 if alive else 20,
            smoothing=0.05, leave=True, bar_format="{n}/{total} |{bar}| {rate_fmt}, {remaining} left{postfix}",
        )  # fmt: skip
        self._show()

    def count(self, success: bool) -> None:
        """One more run."""
        self._failed += not success
        self._show()
        self._bar.update()

    def say(self, text: str) -> None:
        """A line above the bar."""
        self._bar.write(text, file=sys.stderr)

    def close(self) -> None:
        """Leaves the bar as it is."""
        self._bar.close()

    def _show(self) -> None:
        self._bar.set_postfix_str(f"{self._failed} failed", refresh=False)
