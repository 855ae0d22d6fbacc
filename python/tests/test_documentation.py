"""Examples of docstrings run, and every public name has one."""

import doctest
import importlib
import inspect
import pkgutil
import warnings

import pytest
from conftest import ROOT, blocks

import brinell

#: What every session has, and those that an extra installs.
MODULES = sorted(f"brinell.{m.name}" for m in pkgutil.iter_modules(brinell.__path__) if not m.name.startswith("_"))


@pytest.mark.parametrize("name", ["brinell", *MODULES])
def test_prop_examples_of_docstrings_run(name):
    try:
        module = importlib.import_module(name)
    except ImportError as error:
        pytest.skip(str(error))
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    with warnings.catch_warnings():
        # What a reader copies gives no result that misleads.
        warnings.simplefilter("error", brinell.ScenarioWarning)
        failed, tried = doctest.testmod(module, optionflags=flags, raise_on_error=False)
    assert failed == 0 and tried > 0


def test_prop_every_public_name_is_explained():
    for name in brinell.__all__:
        thing = getattr(brinell, name)
        if inspect.isfunction(thing):
            assert "Examples\n" in (thing.__doc__ or ""), name
        elif inspect.isclass(thing):
            assert thing.__doc__, name
            for part, member in vars(thing).items():
                if not part.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)):
                    assert member.__doc__, f"{name}.{part}"


@pytest.mark.parametrize("name", ["docs/src/python.md"])
def test_prop_examples_of_the_texts_run(name, monkeypatch):
    monkeypatch.chdir(ROOT)
    program = blocks(name)
    assert "brinell" in program
    with warnings.catch_warnings():
        warnings.simplefilter("error", brinell.ScenarioWarning)
        exec(compile(program, name, "exec"), {})
