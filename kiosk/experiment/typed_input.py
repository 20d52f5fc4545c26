"""What visitors type: texts that can be kept, and whole numbers with digits of any script."""

from __future__ import annotations

from unicodedata import category

from kiosk.lazy_dataclass import dataclass

_REFUSED = frozenset({"Cc", "Cs"})
"""Control characters, and halves of characters, which no file can hold. Everything else is kept as it was typed."""

_MINUS_SIGNS = "-\N{MINUS SIGN}\N{FULLWIDTH HYPHEN-MINUS}\N{SMALL HYPHEN-MINUS}"
"""What keyboards and input methods send for a minus sign."""


def can_be_kept(text: str) -> bool:
    """Tell whether a text can be stored as it was typed: it holds no control character."""
    return not any(category(character) in _REFUSED for character in text)


@dataclass(frozen=True)
class NumberInput:
    """A field for whole numbers from ``lowest`` to ``highest``, with digits of any script."""

    lowest: int
    highest: int

    @property
    def has_minus(self) -> bool:
        """Whether a negative number can be entered."""
        return self.lowest < 0

    @property
    def longest(self) -> str:
        """The longest number that is allowed, as a text."""
        return max(str(self.lowest), str(self.highest), key=len)

    @property
    def digits(self) -> int:
        """How many digits the longest number has."""
        return max(len(str(abs(end))) for end in (self.lowest, self.highest))

    @property
    def pattern(self) -> str:
        """A regular expression for everything that may stand in the field while a number is typed."""
        sign = f"[{_MINUS_SIGNS}]?" if self.has_minus else ""
        return rf"^{sign}\p{{Nd}}{{0,{self.digits}}}$"

    def read(self, text: str) -> int | None:
        """Read the number that stands in the field; return None if it is none, or has too many digits."""
        digits = text[1:] if self.has_minus and text[:1] in tuple(_MINUS_SIGNS) else text
        # Python reads no number of thousands of digits.
        if not digits.isdecimal() or len(digits) > self.digits:
            return None
        return int(digits) if digits == text else -int(digits)

    def step(self, text: str, by: int) -> int:
        """Return the next number up or down; from no number, up begins at the lowest and down at the highest."""
        now = self.read(text)
        if now is None:
            return self.lowest if by > 0 else self.highest
        return max(self.lowest, min(self.highest, now + by))

    def negate(self, text: str) -> str:
        """Put a minus sign before what stands in the field, or take it away."""
        return text[1:] if text[:1] in tuple(_MINUS_SIGNS) else f"-{text}"
