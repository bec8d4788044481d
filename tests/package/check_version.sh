#!/usr/bin/env bash
# The version of CMakeLists.txt is the one that the changelog and the conda recipe speak of: check_version.sh VERSION
set -euo pipefail
version=$1
cd "$(dirname "$0")/../.."

latest=$(sed -n 's/^## \([0-9].*\)/\1/p' CHANGELOG.md | head -n 1)
[ "$latest" = "$version" ] || { echo "the changelog's latest version is $latest, and not $version"; exit 1; }
grep -qFx "  version: \"$version\"" packaging/conda/recipe.yaml || { echo "the conda recipe is not of $version"; exit 1; }
