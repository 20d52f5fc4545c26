"""Messages that Fluent forms, each parsed when it is first said.

Loading Fluent takes as long as a fifth of an empty window's whole start. Until a message needs it, this module is not
imported: see ``late_messages``.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, cast

from babel.plural import PluralRule, to_python
from fluent.runtime import FluentBundle, FluentResource
from fluent.runtime.resolver import Message
from fluent.syntax.ast import Identifier, Pattern, Placeable, Resource, TextElement, VariableReference
from fluent.syntax.ast import Message as Entry

from kiosk.assistance.late_messages import plain_parts

if TYPE_CHECKING:
    from babel import Locale


# Parsing a language takes a tenth of a second, and every decision that is explained and every study that is read needs
# one. A parsed file is never changed: a bundle compiles it into objects of its own.
parsed_file = lru_cache(maxsize=64)(FluentResource)


# A bundle compiles it into objects of its own and never changes it.
@lru_cache(maxsize=1024)
def parsed(text: str) -> Resource:
    """Return what Fluent makes of a message's text; a plain one takes a tenth of the time."""
    plain = plain_parts(text)
    if plain is None:
        return FluentResource(text)
    elements = [_variable(part) if number % 2 else TextElement(part) for number, part in enumerate(plain[1]) if part]
    return Resource([Entry(Identifier(plain[0]), Pattern(elements))])


def _variable(name: str) -> Placeable:
    return Placeable(VariableReference(Identifier(name)))


class _NoLocale:
    plural_form: ClassVar[PluralRule] = PluralRule({})


class LateBundle(FluentBundle):
    """A bundle that also knows messages by their text alone, and reads plural rules when it needs them."""

    def __init__(self, locales: list[str], late: dict[str, str]) -> None:
        """Know the messages and terms in ``late``, by their names; what is parsed is taken out of it.

        The marks that isolate a variable's writing direction are for mixed scripts; a voice would stumble on them.
        """
        super().__init__(locales, use_isolating=False)
        # Fluent has set these to what stands in for them; the true ones are read from files of Babel.
        del self._babel_locale, self._plural_form
        self._late = late

    def _get_babel_locale(self) -> Locale:
        return cast("Locale", _NoLocale)

    def __getattr__(self, name: str) -> Any:
        """Read what Fluent needs of a language, such as its plural rules, when it first asks for it."""
        match name:
            case "_babel_locale":
                found: Any = super()._get_babel_locale()
            case "_plural_form":
                found = to_python(self._babel_locale.plural_form)
            case _:
                raise AttributeError(name)
        setattr(self, name, found)
        return found

    def add_resource(self, resource: Resource, allow_overrides: bool = False) -> None:  # noqa: FBT001, FBT002 - Fluent's
        """Add what is parsed."""
        for entry in resource.body:
            if hasattr(entry, "id"):
                self._late.pop(entry.id.name if isinstance(entry, Entry) else f"-{entry.id.name}", None)
        super().add_resource(resource, allow_overrides)

    def has_message(self, message_id: str) -> bool:
        """Whether there is such a message."""
        return message_id in self._late or super().has_message(message_id)

    def _lookup(self, entry_id: str, term: bool = False) -> Message:  # noqa: FBT001, FBT002 - Fluent's
        # The resolver finds messages and terms that others refer to by this method alone.
        name = f"-{entry_id}" if term else entry_id
        if name in self._late:
            self.add_resource(parsed(self._late[name]))
            if self._late.pop(name, None) is not None:
                # The file was changed and is broken here: a message without a text is said in the next language.
                super().add_resource(Resource([Entry(Identifier(entry_id))]))
        return super()._lookup(entry_id, term)
