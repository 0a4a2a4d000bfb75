"""Extensions of griffe, for the API reference.

* The root imports its names when they are used. A stub lists them.
* griffe takes attributes that `bearingcore.common._lazy.cached_property` makes for calls.
* Some methods of a class are functions of other modules: ``paired = paired``.
"""

import re
from typing import Any

from griffe import Attribute, Class, Extension, Function, GriffeError, Module, Parameters

COMPUTED_ONCE = "bearingcore.common._lazy.cached_property"
BORROWED = re.compile(r"(?:(classmethod|property)\()?([\w.]+)\)?")
"""The value of an attribute that is a function of another module."""


def as_property(name: str, function: Function, label: str) -> Attribute:
    """The attribute that a function makes as a property."""
    made = Attribute(
        name,
        lineno=function.lineno,
        endlineno=function.endlineno,
        annotation=function.returns,
        docstring=function.docstring,
    )
    made.labels |= {label, "property"}
    return made


class ComputedOnce(Extension):
    """Makes properties of functions that are computed once."""

    def on_class(self, *, cls: Class, **_: Any) -> None:
        """Change the members of a class that was read."""
        for name, member in list(cls.members.items()):
            if isinstance(member, Function) and any(
                decorator.callable_path == COMPUTED_ONCE for decorator in member.decorators
            ):
                cls.set_member(name, as_property(name, member, "cached"))


class BorrowedMethods(Extension):
    """Makes methods of functions that a class takes from other modules."""

    def on_package(self, *, pkg: Module, **_: Any) -> None:
        """Look at all classes of the package, once all its modules are there."""
        modules = [pkg]
        for module in modules:
            modules += [inner for inner in module.modules.values() if not inner.is_alias]
            for cls in module.classes.values():
                if not cls.is_alias:
                    self.look_at(pkg, module, cls)

    def look_at(self, pkg: Module, module: Module, cls: Class) -> None:
        """Replace attributes of a class whose value is a function of the package."""
        for name, member in list(cls.members.items()):
            value = BORROWED.fullmatch(str(getattr(member, "value", None) or ""))
            if not isinstance(member, Attribute) or value is None:
                continue
            kind, path = value.groups()
            try:
                first, *rest = path.split(".")
                function = pkg.modules_collection[".".join([module.resolve(first), *rest])]
                function = function.final_target if function.is_alias else function
            except (GriffeError, KeyError):
                continue
            if not isinstance(function, Function):
                continue
            if kind == "property":
                cls.set_member(name, as_property(name, function, "property"))
                continue
            method = Function(
                name,
                parameters=Parameters(*list(function.parameters)[1:]),
                returns=function.returns,
                lineno=function.lineno,
                endlineno=function.endlineno,
                docstring=function.docstring,
            )
            method.labels |= {kind} if kind else set()
            cls.set_member(name, method)


class NamesOfStubs(Extension):
    """Makes the names that a stub imports the public names of its package."""

    def on_package(self, *, pkg: Module, **_: Any) -> None:
        """Export them, unless the package says what it exports."""
        pkg.members.pop("lazy_loader", None)
        if not isinstance(pkg.exports, list) or not pkg.exports:
            pkg.exports = [name for name, member in pkg.members.items() if member.is_alias]
