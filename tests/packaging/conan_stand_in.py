# SPDX-License-Identifier: BSL-1.0
"""Stand-ins for what a recipe takes from conan 2, enough to make a package of headers: the documented meaning of the
functions, nothing of the tool."""
import fnmatch
import importlib.util
import pathlib
import shutil
import sys
import types


class Version:
    def __init__(self, text):
        self.numbers = [int(part) for part in str(text).split(".")]

    def __lt__(self, other):
        return self.numbers < Version(other).numbers


class ConanInvalidConfiguration(Exception):
    pass


def copy(_recipe, pattern, source, target):
    """Keeps folders below `source`; patterns match whole paths below it, `*` across folders."""
    found = [path for path in pathlib.Path(source).rglob("*")
             if path.is_file() and fnmatch.fnmatch(path.relative_to(source).as_posix(), pattern)]
    for path in found:
        to = pathlib.Path(target) / path.relative_to(source)
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, to)


class Recipe:
    """The recipe in a file, whose package comes to lie in folder/package."""

    def __init__(self, file, folder):
        modules = {
            "conan": {"ConanFile": type("ConanFile", (), {})},
            "conan.errors": {"ConanInvalidConfiguration": ConanInvalidConfiguration},
            "conan.tools": {},
            "conan.tools.build": {"check_min_cppstd": lambda recipe, standard: None},
            "conan.tools.files": {"copy": copy, "load": lambda recipe, path: pathlib.Path(path).read_text()},
            "conan.tools.layout": {"basic_layout": lambda recipe: None},
            "conan.tools.scm": {"Version": Version},
        }
        for name, members in modules.items():
            sys.modules[name] = types.ModuleType(name)
            vars(sys.modules[name]).update(members)
        spec = importlib.util.spec_from_file_location("recipe", file)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        self.kind = module.ScarpConan
        self.file = file
        self.folder = folder
        self.required = []
        self.properties = {}

    def _started(self, compiler, version):
        recipe = self.kind()
        recipe.recipe_folder = str(self.file.parent)
        recipe.export_sources_folder = recipe.source_folder = str(self.folder / "sources")
        recipe.package_folder = str(self.folder / "package")
        recipe.info = types.SimpleNamespace(clear=lambda: None)
        recipe.requires = lambda reference, **_: self.required.append(reference)
        recipe.cpp_info = types.SimpleNamespace(set_property=self.properties.__setitem__)

        class Compiler(str):
            pass

        named = Compiler(compiler)
        named.version = version
        recipe.settings = types.SimpleNamespace(compiler=named, os="Linux")
        return recipe

    def make(self, compiler, version):
        recipe = self._started(compiler, version)
        for step in ("set_version", "export_sources", "layout", "requirements", "package_id", "validate", "package",
                     "package_info"):
            getattr(recipe, step)()
        return recipe

    def refuses(self, compiler, version):
        try:
            self._started(compiler, version).validate()
        except ConanInvalidConfiguration:
            return True
        return False
