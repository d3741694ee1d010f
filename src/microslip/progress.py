"""Progress bars on standard error, around generators that know nothing of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeAlias, TypeVar

from microslip.interruption import unmasked

Item = TypeVar("Item")
Watch: TypeAlias = Callable[[Iterable[Any]], Iterator[Any]]
"""what a command puts around a generator to show its progress"""
ROUNDING = 1e-6
"""share of the way that is none: no time left is told from it"""


def shown(
    items: Iterable[Item],
    *,
    total: float,
    done: Callable[[Item], float],
    unit: str,
    name: str,
) -> Iterator[Item]:
    """Pass items through and keep a bar; ``done`` tells how far an item has come.

    The bar is off where standard error is no terminal.
    """
    from tqdm import tqdm

    form = (
        "{desc}: {percentage:3.0f}%|{bar}| {n:.4g}/{total:.4g} {unit} "
        "[{elapsed}<{remaining}]"
    )
    bar = tqdm(total=total, desc=name, unit=unit, disable=None, bar_format=form)
    with unmasked(), bar:
        for item in items:
            further = min(done(item), total) - bar.n
            bar.update(further if further > ROUNDING * total else 0.0)
            yield item


def collected(
    items: Iterable[Item], found: list[Item], *, total: int, unit: str, name: str
) -> Iterator[Item]:
    """Pass items through into a list, with a bar that counts them.

    What is in the list stays there when the items end early.
    """
    for item in shown(
        items, total=total, done=lambda _: len(found) + 1.0, unit=unit, name=name
    ):
        found.append(item)
        yield item
