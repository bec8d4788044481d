"""Checks the recipe for conda, without a build: check_recipe.py VERSION. Needs py-rattler-build.

rattler-build parses it, which refuses what no recipe has, and renders it for Linux. Its outputs must be the
library and the Python package, of this version.
"""

import sys
from pathlib import Path

from rattler_build import PlatformConfig, RenderConfig, Stage0Recipe, VariantConfig

recipe = Stage0Recipe.from_file(Path(__file__).with_name("recipe.yaml"))
variants = VariantConfig({"python": ["3.11.*"], "cxx_compiler": ["gxx"], "c_stdlib": ["sysroot"]})
rendered = recipe.render(variants, RenderConfig(PlatformConfig(target_platform="linux-64")))
packages = {output.recipe.package.name: output.recipe.package.version for output in rendered}
expected = {"libvorocl": sys.argv[1], "vorocl": sys.argv[1]}
if {name: str(version) for name, version in packages.items()} != expected:
    sys.exit(f"the recipe makes {packages}, and not {expected}")
