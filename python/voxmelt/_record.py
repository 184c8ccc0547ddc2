"""What the classes of records and enumerations have in common. The module applies it to each of them.

It is Python, because pprint cannot take methods that are not.
"""
from __future__ import annotations

from inspect import Parameter, Signature
from typing import Any, Optional, Tuple


def values_of(self: Any) -> Tuple[Any, ...]:
    return tuple(getattr(self, name) for name in self.__match_args__)


def _repr(self: Any) -> str:
    fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__match_args__)
    return f"{type(self).__name__}({fields})"


def _eq(self: Any, other: Any) -> Any:
    return values_of(self) == values_of(other) if type(self) is type(other) else NotImplemented


def _hash(self: Any) -> int:
    return hash(values_of(self))


def _reduce(self: Any) -> Any:
    return type(self), values_of(self)


def replace(self: Any, **changes: Any) -> Any:
    """Returns a copy in which the named fields have other values."""
    return type(self)(**{**dict(zip(self.__match_args__, values_of(self))), **changes})


def finish(cls: Any, names: Tuple[str, ...], defaults: Optional[Any]) -> None:
    """Gives a class whose objects do not change what values have: they are compared, shown, copied and kept."""
    setattr(cls, "__match_args__", names)  # mypy takes the plain assignment for a mistake
    cls.__repr__, cls.__eq__, cls.__hash__ = _repr, _eq, _hash
    cls.__module__ = "voxmelt"
    if defaults is None:
        return
    cls.__reduce__, cls.replace = _reduce, replace
    cls.__signature__ = Signature([Parameter(name, Parameter.POSITIONAL_OR_KEYWORD, default=getattr(defaults, name))
                                   for name in names])


def _repr_of_enum(self: Any) -> str:
    return f"{type(self).__name__}.{self.name}"


def finish_enum(cls: Any) -> None:
    cls.__repr__ = _repr_of_enum
    cls.__module__ = "voxmelt"
