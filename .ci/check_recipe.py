"""Holds packaging/conda/recipe.yaml against Cargo.toml and pyproject.toml, as conda's build tool reads it: check_recipe.py"""

import sys
import tomllib
from pathlib import Path

from rattler_build import PlatformConfig, RenderConfig, Stage0Recipe, VariantConfig

cargo = tomllib.loads(Path("Cargo.toml").read_text())["workspace"]["package"]
pyproject = tomllib.loads(Path("pyproject.toml").read_text())
project, maturin = pyproject["project"], pyproject["build-system"]["requires"][0]
oldest = project["requires-python"].removeprefix(">=")

# What conda-forge gives to a recipe with one package for all Pythons.
given = {"python": [f"{oldest}.* *_cpython"], "python_min": [oldest], "is_abi3": [True], "is_python_min": [True]}
given |= {"c_compiler": ["gcc"], "c_stdlib": ["sysroot"], "rust_compiler": ["rust"]}
problems = []


def same(what: str, recipe: object, here: object) -> None:
    if recipe != here:
        problems.append(f"{what}: {recipe} in packaging/conda/recipe.yaml, {here} here")


for platform in ["linux-64", "linux-aarch64", "osx-64", "osx-arm64", "win-64"]:
    (variant,) = Stage0Recipe.from_file("packaging/conda/recipe.yaml").render(
        VariantConfig(given), RenderConfig(platform=PlatformConfig(target_platform=platform))
    )
    recipe = variant.recipe.to_dict()
    same("name", recipe["package"]["name"], project["name"])
    same("version", recipe["package"]["version"], cargo["version"])
    same("licence", recipe["about"]["license"], cargo["license"])
    same("summary", recipe["about"]["summary"], project["description"])
    # THIRDPARTY.yml is made by the build.
    same("licence files", sorted(recipe["about"]["license_file"]), sorted([*project["license-files"], "THIRDPARTY.yml"]))
    for file in project["license-files"]:
        same(f"the file {file}", Path(file).is_file(), True)
    needs = sorted(need.replace(" ", "") for need in recipe["requirements"]["run"])
    same("run", needs, sorted(["python", *project["dependencies"]]))
    host = [need.replace(" ", "") for need in recipe["requirements"]["host"]]
    same("maturin", [need for need in host if need.startswith("maturin")], [maturin])
    (pythons,) = [test["python"]["python_version"] for test in recipe["tests"] if "python" in test]
    same("oldest Python", pythons[0], f"{oldest}.*")
sys.exit("\n".join(dict.fromkeys(problems)) or 0)
