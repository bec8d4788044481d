#!/usr/bin/env bash
# Builds the source distribution, and of it the wheel as others can install it, and runs in a fresh environment the tests,
# all examples and the benchmark: run.sh FOLDER
# Exits with 77 where "tools/setup.sh check" has not laid ready the packages that they need.
set -euo pipefail
folder=$1
cd "$(dirname "$0")/../.."

wheels=${XDG_CACHE_HOME:-$HOME/.cache}/vorocl/$(python3 -c "import sys; print(sys.implementation.cache_tag)")
if ! cmp -s python/tests/requirements.txt "$wheels/requirements.txt"; then
  echo "the Python packages of python/tests/requirements.txt are not installed: skipped"
  exit 77
fi

rm -rf "$folder"
python3 -m venv "$folder/environment"
python=$folder/environment/bin/python
export PIP_NO_INDEX=1 PIP_FIND_LINKS=$wheels PIP_DISABLE_PIP_VERSION_CHECK=1
"$python" -m pip install --quiet --no-compile --requirement python/tests/requirements.txt
"$python" -c 'import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])' "$folder" >/dev/null
"$python" -m pip wheel --quiet --no-deps --wheel-dir "$folder" "$folder"/vorocl-*.tar.gz \
  --config-settings cmake.define.VOROCL_WARNINGS_AS_ERRORS=ON
PATH=$(dirname "$python"):$PATH "$python" -m auditwheel repair --wheel-dir "$folder/repaired" "$folder"/vorocl-*.whl
"$python" -m pip install --quiet "$folder"/repaired/vorocl-*-manylinux_*.whl
if "$python" -m zipfile -l "$folder"/repaired/vorocl-*.whl | grep -i opencl | grep -v _opencl.py; then
  echo "the wheel has an OpenCL loader of its own"
  exit 1
fi

"$python" -m pytest -q -p no:cacheprovider --doctest-modules --pyargs vorocl python/tests
for example in python/examples/*.py; do
  "$python" "$example" "$folder/$(basename "$example" .py).png"
done
for page in README.md docs/python.md; do
  sed -n '/^```python$/,/^```$/{/^```/!p}' "$page" | "$python" -
done
"$python" python/benchmarks/compare.py --size 256 --seeds 64 1024 --repeat 1
