"""The distribution of the repository's root under another name, requiring build123d instead of CadQuery."""

import tomllib
from pathlib import Path

from setuptools import setup
from setuptools_rust import Binding, RustExtension

TOP = "../.."
root = tomllib.loads((Path(__file__).resolve().parent / TOP / "pyproject.toml").read_text("utf-8"))
project, tools = root["project"], root["tool"]["setuptools"]


def without_cadquery(requirements: list[str]) -> list[str]:
    """The requirements but those that decide which OpenCASCADE there is."""
    return [each for each in requirements if not each.startswith(("cadquery", "build123d"))]


setup(
    name=f"{project['name']}-build123d",
    version=project["version"],
    description=project["description"],
    python_requires=project["requires-python"],
    install_requires=[*without_cadquery(project["dependencies"]), "build123d>=0.13"],
    extras_require={name: without_cadquery(each) for name, each in project["optional-dependencies"].items()},
    entry_points={"console_scripts": [f"{name} = {place}" for name, place in project["scripts"].items()]},
    packages=tools["packages"],
    package_dir={"hlr": f"{TOP}/hlr"} | {name: f"{TOP}/{path}" for name, path in tools["package-dir"].items()},
    package_data=tools["package-data"],
    include_package_data=False,
    rust_extensions=[
        RustExtension(
            "hlr._kernel", f"{TOP}/hlr/kernel/Cargo.toml", binding=Binding.PyO3, debug=False, py_limited_api=True
        )
    ],
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
