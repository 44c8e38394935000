"""What ends a campaign early."""


class CampaignError(Exception):
    """A text for a person, the code that stands before it, and the exit status: 1 not all was done, 2 bad usage,
    nothing was started, 3 the machine failed."""

    def __init__(self, status: int, code: str, text: str):
        super().__init__(text)
        self.status = status
        self.code = code


def bad_usage(text: str) -> CampaignError:
    """What was typed is wrong; nothing was started."""
    return CampaignError(2, "bad_usage", text)


class HostFailed(Exception):
    """A worker's machine could not carry out a run, which says nothing of the run. Raised on workers, so it is passed
    on by its text alone."""
