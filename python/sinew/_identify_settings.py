"""Settings of the methods of sinew.identify, as the program's options have them."""

import os
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

Path = Union[str, "os.PathLike[str]"]
Quantity = Union[float, int, str]
Quantities = Union[Quantity, Sequence[Quantity]]
Prior = Union[str, Sequence[Quantity]]


def with_unit(value: Any) -> str:
    """Return text as it is, and a number as one in the SI unit of whatever it is of."""
    return value if isinstance(value, str) else f"{float(value)!r} SI"


def in_meters(value: Any) -> str:
    """Return text as it is, and a number as a length."""
    return value if isinstance(value, str) else f"{float(value)!r} m"


def wishes(
    freeze: Optional[Mapping[str, Quantity]],
    prior: Optional[Mapping[str, Prior]],
    tie: Optional[Mapping[str, str]],
) -> "Dict[str, List[str]]":
    """Return what is known of parameters, as the program's options have it."""

    def belief(of: Prior) -> str:
        return of if isinstance(of, str) else "±".join(with_unit(one) for one in of)

    return {
        "freeze": [f"{name}={with_unit(value)}" for name, value in (freeze or {}).items()],
        "prior": [f"{name}={belief(of)}" for name, of in (prior or {}).items()],
        "tie": [f"{name}={other}" for name, other in (tie or {}).items()],
    }
