"""The halves of the core serve without each other, and are imported when they are used."""

import subprocess
import sys
from importlib import import_module, metadata
from pkgutil import walk_packages

import pytest

import bearingcore

LIST_MODULES = "import sys, bearingcore; bearingcore.{name}; print(*sorted(sys.modules))"


def modules_after(name: str) -> set[str]:
    """The modules that an empty process holds once it has asked for a public name."""
    command = [sys.executable, "-c", LIST_MODULES.format(name=name)]
    return set(subprocess.run(command, check=True, capture_output=True, text=True).stdout.split())


def test_the_root_alone_imports_nothing_that_takes_time() -> None:
    modules = modules_after("__version__")
    assert not modules & {"numpy", "scipy", "numba", "pandas"}
    assert {name for name in modules if name.startswith("bearingcore")} == {"bearingcore"}


def test_diagnosing_loads_neither_the_model_nor_a_compiler() -> None:
    modules = modules_after("diagnose")
    assert "bearingcore.measured.diagnosis" in modules
    assert not modules & {"numba", "bearingcore.model", "bearingcore.sizing"}


def test_statics_load_no_reader_of_files_and_no_compiler_before_they_solve() -> None:
    modules = modules_after("equilibrium")
    assert "bearingcore.model.statics" in modules
    assert not modules & {"bearingcore.measured", "bearingcore.sizing", "pandas", "h5py", "numba"}


@pytest.mark.parametrize("name", bearingcore.__all__)
def test_every_public_name_is_there(name: str) -> None:
    thing = getattr(bearingcore, name)
    assert name in dir(bearingcore)
    module = getattr(thing, "__module__", "bearingcore")
    assert module.startswith(("bearingcore", "builtins", "types", "numpy")), module


def test_no_public_name_is_that_of_a_public_module_and_inner_modules_are_private() -> None:
    modules = {"bearingcore": True}
    modules |= {m.name: m.ispkg for m in walk_packages(bearingcore.__path__, "bearingcore.")}
    public = [name for name in modules if "._" not in name]
    single = {name for name in public if not modules[name]}
    assert single == {f"bearingcore.{name}" for name in ("errors", "fields", "units")}
    for front in public:
        names = {thing for thing in dir(import_module(front)) if f"{front}.{thing}" not in modules}
        assert not names & {name.rpartition(".")[2] for name in public}, front


def test_the_version_is_that_of_the_distribution() -> None:
    assert bearingcore.__version__ == metadata.version("bearing-explorer")
