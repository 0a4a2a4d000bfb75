"""For the API reference: attributes that are computed once are shown as properties.

griffe knows `functools.cached_property` only, and takes `bearingcore.common._lazy.cached_property`
for a call.
"""

from typing import Any

from griffe import Attribute, Class, Extension, Function

COMPUTED_ONCE = "bearingcore.common._lazy.cached_property"


class ComputedOnce(Extension):
    """Makes attributes of such functions."""

    def on_class(self, *, cls: Class, **_: Any) -> None:
        """Change the members of a class that was read."""
        for name, member in list(cls.members.items()):
            if isinstance(member, Function) and any(
                decorator.callable_path == COMPUTED_ONCE for decorator in member.decorators
            ):
                cls.set_member(
                    name,
                    made := Attribute(
                        name,
                        lineno=member.lineno,
                        endlineno=member.endlineno,
                        annotation=member.returns,
                        docstring=member.docstring,
                    ),
                )
                made.labels |= {"cached", "property"}
