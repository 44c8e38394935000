"""The campaign as a page of HTML."""


def of(results) -> str:
    return "<html></html>"
