"""shapely, opened at its first use: opening it takes half as long as all of numpy, and most programs need no areas."""

from typing import Any


def __getattr__(name: str) -> Any:
    import shapely

    found = globals()[name] = getattr(shapely, name)
    return found
