"""For the API reference: what the root imports when it is used, and properties computed once.

The root's names stand in its stub, as imports under their own names, which is how a stub exports.

griffe knows `functools.cached_property` only, and takes `bearingcore.common._lazy.cached_property`
for a call.
"""

from typing import Any

from griffe import Attribute, Class, Extension, Function, Module

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


class NamesOfStubs(Extension):
    """Makes names that the stub of a package imports its public names."""

    def on_package(self, *, pkg: Module, **_: Any) -> None:
        """Export them, unless the package says what it exports."""
        if not isinstance(pkg.exports, list) or not pkg.exports:
            pkg.exports = [name for name, member in pkg.members.items() if member.is_alias]
