"""What is wrong with a model or an argument."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Fault:
    """One fault: what is wrong, where, and what to do."""

    message: str
    """What is wrong."""
    hint: str | None = None
    """What to do about it."""
    argument: str | None = None
    """The argument in which it lies; None if it lies in the model."""
    text: str | None = None
    """The faulty text."""
    line: int | None = None
    """Its line in the model or in the argument, from 1; None where the fault concerns the whole."""
    column: int | None = None
    """Its column, from 1."""
    is_warning: bool = False
    """Whether it is only perhaps not meant."""

    def __str__(self) -> str:
        place = ""
        if self.argument is not None:
            place = f"argument {self.argument}: "
        elif self.line is not None:
            place = f"line {self.line}, column {self.column}: "
        hint = f"\n    hint: {self.hint}" if self.hint else ""
        return f"{place}{self.message}{hint}"


class ModelError(ValueError):
    """A model or its settings make no sense; `faults` has everything that is wrong, in the order of its places.

    >>> import slideway
    >>> try:
    ...     slideway.Model.gallery("drawer").with_(my=0.5)
    ... except slideway.ModelError as error:
    ...     print(error.faults[0].message)
    there is no parameter named `my`
    """

    faults: tuple[Fault, ...]
    filename: str | None = None
    """The file of the model, if it was loaded from one."""

    def __init__(self, faults: tuple[Fault, ...]) -> None:
        super().__init__(faults)
        self.faults = faults

    def __str__(self) -> str:
        place = f"{self.filename}: " if self.filename else ""
        return "\n".join(f"{place}{fault}" for fault in self.faults)
