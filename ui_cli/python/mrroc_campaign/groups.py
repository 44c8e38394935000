"""Runs side by side over one varied value."""

_MOST_VALUES = 10  # that each have a group of their own
_MOST_GROUPS = 6


def grouped(values: list) -> list[list]:
    """The different values in groups, in their order: each alone where there are few, otherwise neighbours together so
    that groups have about as many of `values`. Equal ones are always in one group, and one that is as frequent as a
    group is large is alone."""
    counts = {value: values.count(value) for value in sorted(set(values))}
    if len(counts) <= _MOST_VALUES:
        return [[value] for value in counts]
    size = len(values) / min(_MOST_GROUPS, max(2, len(values) // 10))
    groups, held = [[]], 0
    for value, count in counts.items():
        if groups[-1] and (held + count / 2 > size or count >= size):
            groups.append([])
            held = 0
        groups[-1].append(value)
        held += count
        if count >= size:
            groups.append([])
            held = 0
    return [group for group in groups if group]
