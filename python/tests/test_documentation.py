"""Examples of docstrings run, and every public name has one."""

import doctest
import importlib
import inspect
import pathlib
import pkgutil

import pytest

import brinell

#: What every session has, and those that an extra installs.
MODULES = sorted(f"brinell.{m.name}" for m in pkgutil.iter_modules(brinell.__path__) if not m.name.startswith("_"))


@pytest.mark.parametrize("name", ["brinell", *MODULES])
def test_prop_examples_of_docstrings_run(name):
    try:
        module = importlib.import_module(name)
    except ImportError as error:
        pytest.skip(str(error))
    failed, tried = doctest.testmod(module, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE, raise_on_error=False)
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


def blocks(path):
    """Every block of Python in a Markdown file, as one program."""
    inside, lines = False, []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("```"):
            inside = line == "```python"
        elif inside:
            lines.append(line)
    return "\n".join(lines)


@pytest.mark.parametrize("name", ["README.md", "docs/src/python.md"])
def test_prop_examples_of_the_texts_run(name, monkeypatch):
    root = pathlib.Path(__file__).resolve().parents[2]
    monkeypatch.chdir(root)
    program = blocks(root / name)
    assert "brinell" in program
    exec(compile(program, name, "exec"), {})
